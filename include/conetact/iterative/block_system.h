// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_block_system_h
#define conetact_iterative_block_system_h

#include "conetact/iterative/flexible_gmres.h"
#include "conetact/iterative/multigrid.h"
#include "conetact/iterative/preconditioner.h"
#include "conetact/iterative/row_runs.h"
#include "conetact/iterative/surface_smoother.h"
#include "conetact/solvers/large_system.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace conetact::iterative
{
  /** Unknowns that need no levels: solved directly, by one process. */
  constexpr int small_enough = 600;

  /** What a process has of the unknowns of all nodes, `block` places each. */
  template <int block>
  struct BlockShare
  {
    Communicator     processes;
    std::vector<int> first; ///< places of process p: first[p], first[p]+1, ...
    /** Own rows; columns are those of all processes. */
    BlockMatrix<block, block, double> K;
    Eigen::VectorXd                   exists;  ///< 0: a place of no unknown
    std::vector<std::vector<int>>     contact; ///< own places, node by node
    /** Nodes of all processes that are smoothed together, ascending. */
    std::vector<int> surface;
    Eigen::MatrixXd  modes;
    Preconditioner   preconditioner = Preconditioner::aggregation;
    std::vector<int> side; ///< of own nodes, see aggregates()
  };

  /**
   * The linear systems of make_large_system(), of which each process has its
   * own nodes. All processes call the same functions, each with its part of the
   * vectors and with the laws of its own contact nodes.
   */
  template <int block>
  class BlockSystem
  {
  public:
    using Index     = Eigen::Index;
    using Array     = Eigen::VectorXd;
    using NodeLaw   = solvers::NodeLaw;
    using Precision = solvers::LargeSystem::Precision;

    /** As LargeSystem::Step has it. */
    struct Step
    {
      Array        du;
      unsigned int iterations = 0;
      double       error      = 0;
    };

    explicit BlockSystem(BlockShare<block> given);

    /** K x. */
    Array
    multiply(const Array &x) const;
    Array
    diagonal() const;
    Step
    solve(const std::vector<NodeLaw> &laws,
          const Array                &f,
          const Precision            &precision) const;

  private:
    using SmallMatrix = solvers::SmallMatrix;
    using FloatBlock  = Eigen::Matrix<float, block, block>;

    /** Rows of a node that stay: y_u += S x_u + Q y_k. */
    struct NodeRows
    {
      std::size_t      node;         ///< among contact nodes
      std::vector<int> stays, known; ///< places
      SmallMatrix      S, Q;
    };
    /** The linear system of a step. */
    struct System
    {
      Array                 free; ///< 1 or 0 [-]
      FloatVector           free_float;
      std::vector<NodeRows> rows;
      Array                 known, right_hand_side;
    };

    /** Number of the block (i, i) of the own part of matrices. */
    std::size_t
    diagonal_block(const int i) const;
    /** Of vectors of which each process has its part. */
    template <typename Vector>
    double
    norm(const Vector &x) const
    {
      return std::sqrt(processes.sum(x.squaredNorm()));
    }
    void
    find_near_contact();
    void
    find_scale();
    void
    make_smoother(const std::vector<int> &surface_nodes);
    void
    make_levels(const Eigen::MatrixXd  &modes,
                const std::vector<int> &side,
                const Preconditioner    kind);
    Array
    without_contact() const;
    /** Of a system of few unknowns, with all contact nodes held. */
    Eigen::MatrixXd
    held_matrix() const;
    FloatBlock
    inverse_block(const int i, const Array &free, const FloatBlock &S) const;
    System
    system_of(const std::vector<NodeLaw> &laws, const Array &f) const;
    void
    add_node(const std::size_t i,
             const NodeLaw    &law,
             const Array      &y,
             System           &system) const;
    /** K x, where only contact nodes move. */
    Array
    multiply_contact(const Array &x) const;
    /** Smoother and coarse levels become those of the laws. */
    void
    set_states(const System &system) const;
    /** Turns K x (both over a unit of stiffness) into rows of the laws. */
    template <typename Vector>
    void
    add_laws(const System &system,
             const double  unit,
             const Vector &x,
             Vector       &y) const;
    void
    precondition(const System      &system,
                 const FloatVector &b,
                 FloatVector       &result) const;

    const Communicator                      processes;
    const std::vector<int>                  first;      ///< places of processes
    std::vector<int>                        first_node; ///< their nodes
    const int                               n;          ///< own places
    const int                               n_nodes;
    const Array                             exists; ///< 1 or 0 [-]
    const std::vector<std::vector<int>>     contact;
    std::vector<std::size_t>                near_contact; ///< rows of K
    DistributedMatrix<block, block, double> K;
    double                                  scale = 1; ///< a power of two
    DistributedMatrix<block, block, float>  A;         ///< K over it
    RowRuns<block, double>                  runs_of_K;
    RowRuns<block, float>                   runs_of_A;
    mutable NodeBlocks<block>               D;       ///< of the states
    std::unique_ptr<SurfaceSmoother<block>> surface; ///< none: not needed
    float largest_of_blocks = 1;                     ///< eigenvalue of D A
    float largest           = 1; ///< of the smoother, with the surface
    std::unique_ptr<CoarseCorrection<block>> levels;
    Eigen::LDLT<Eigen::MatrixXd>             whole; ///< of few
    /** Memory for solve(): to ask for it each time takes longer than sums. */
    struct Vectors
    {
      ChebyshevVectors smoothing;
      FloatVector      r, scaled, coarse;
    };
    mutable Vectors       vectors;
    mutable FlexibleGmres gmres;
    /** The last system took many iterations. */
    mutable bool is_hard = false;
  };

  extern template class BlockSystem<2>;
  extern template class BlockSystem<3>;
} // namespace conetact::iterative

#endif
