// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_flexible_gmres_h
#define conetact_iterative_flexible_gmres_h

#include "conetact/base/communicator.h"
#include "conetact/iterative/node_blocks.h"

#include <functional>
#include <vector>

namespace conetact::iterative
{
  /**
   * A cycle of GMRES in single precision whose preconditioner may change from
   * step to step: vectors are kept twice, before and after it. Each process has
   * its part of the vectors. Memory is kept from cycle to cycle: to ask for it
   * each time takes longer than sums.
   */
  class FlexibleGmres
  {
  public:
    using Product = std::function<void(const FloatVector &x, FloatVector &y)>;

    static constexpr unsigned int cycle_length = 40;

    explicit FlexibleGmres(const Communicator &processes);

    /** For |b| = 1: what is left of b is at most `goal`, or what a cycle
     * leaves. Counts its iterations. */
    FloatVector
    solve(const FloatVector &b,
          const double       goal,
          const Product     &multiply,
          const Product     &precondition,
          unsigned int      &iterations);

  private:
    /**
     * Takes away from w what is along the first vectors of V, whose parts are
     * `along`. Returns the norm of what is left.
     */
    double
    orthogonalize(Eigen::Ref<Eigen::VectorXd> along);

    const Communicator       processes;
    std::vector<FloatVector> V, Z;
    FloatVector              w;
    Eigen::MatrixXd          products; ///< V^T V, its lower triangle
  };
} // namespace conetact::iterative

#endif
