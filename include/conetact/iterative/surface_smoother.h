// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_surface_smoother_h
#define conetact_iterative_surface_smoother_h

#include "conetact/iterative/distributed_matrix.h"

#include <Eigen/SparseCholesky>

#include <vector>

namespace conetact::iterative
{
  /**
   * Solves for the nodes of a surface together, as a part of a smoother that
   * treats all others one by one. Where masters carry the nodes of a harder
   * slave, a motion of masters that moves the slave hardly or not at all meets
   * little of what their diagonal blocks say, in spite of its short waves:
   * neither these blocks nor coarse levels reduce it. All processes have the
   * factor of the whole surface.
   */
  template <int block>
  class SurfaceSmoother
  {
  public:
    /** What is added to the block of each node, as a column. */
    using Blocks = Eigen::Matrix<float, block * block, Eigen::Dynamic>;

    /** `nodes`: of all processes, of which this one has the rows of the matrix
     * from `begin` on; the matrix over `scale` is meant. */
    SurfaceSmoother(const DistributedMatrix<block, block, double> &matrix,
                    const double                                   scale,
                    const std::vector<int>                        &nodes,
                    const int                                      begin,
                    const Communicator                            &processes);

    /** Zero, for all own nodes of the surface. */
    Blocks
    no_blocks() const
    {
      return Blocks::Zero(block * block, static_cast<Eigen::Index>(own.size()));
    }
    /** Where an own node, counted from `begin`, stands among them, or -1. */
    Eigen::Index
    find(const int node) const
    {
      const auto it = std::lower_bound(own.begin(), own.end(), node);
      return it == own.end() || *it != node ? -1 : it - own.begin();
    }
    /** For what is free (1, others 0) of all own nodes, with blocks added to
     * those of the surface. */
    void
    factorize(const Eigen::VectorXd &all_free, const Blocks &added);
    /** Sets z at own nodes, from r there. */
    void
    apply(const Eigen::VectorXf &r, Eigen::VectorXf &z) const;

  private:
    using Matrix = Eigen::SparseMatrix<double>;

    /** Of the nodes of the surface, of a vector of all nodes. */
    Eigen::VectorXf
    part_of(const Eigen::VectorXf &x) const;

    Communicator                  processes;
    std::vector<int>              own;
    Eigen::Index                  first = 0; ///< own row among those of all
    Matrix                        whole;     ///< all is free
    Eigen::VectorXf               free;      ///< of all
    Eigen::SimplicialLDLT<Matrix> solver;
    bool                          is_solvable = false;
  };

  extern template class SurfaceSmoother<2>;
  extern template class SurfaceSmoother<3>;
} // namespace conetact::iterative

#endif
