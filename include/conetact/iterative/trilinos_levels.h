// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_trilinos_levels_h
#define conetact_iterative_trilinos_levels_h

#include "conetact/iterative/coarse_correction.h"
#include "conetact/iterative/distributed_matrix.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace conetact::iterative
{
  /**
   * Smoothed aggregation of Trilinos' package ML (Gee, Siefert, Hu, Tuminaro,
   * Sala: ML 5.0 Smoothed Aggregation User's Guide, Sandia 2006) with rigid
   * motions as near null space, through deal.II's PreconditionAMG. Its matrix
   * is A in the present states, in double precision, of one process.
   */
  template <int block>
  class TrilinosLevels : public CoarseCorrection<block>
  {
  public:
    /** K over `scale` is A. `exists`: 0 of places without unknown; `nodes`: the
     * contact nodes. */
    TrilinosLevels(const DistributedMatrix<block, block, double> &K,
                   const double                                   scale,
                   const Eigen::VectorXd                         &exists,
                   const Eigen::MatrixXd                         &modes,
                   const std::vector<int>                        &nodes);
    ~TrilinosLevels() override;

    void
    set_states(const std::vector<NodeState<block>> &states,
               const bool                           exactly) override;
    void
    correct(const FloatVector &r, FloatVector &x) override;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };

  extern template class TrilinosLevels<2>;
  extern template class TrilinosLevels<3>;
} // namespace conetact::iterative

#endif
