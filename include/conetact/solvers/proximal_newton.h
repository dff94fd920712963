// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_proximal_newton_h
#define conetact_solvers_proximal_newton_h

#include "conetact/solvers/large_factor.h"
#include "conetact/solvers/sparse_relation.h"

#include <functional>

namespace conetact::solvers
{
  /**
   * Makes an estimate of redundant reactions exact: semismooth Newton steps on
   * the law of NodeSets with @f$M + \epsilon I@f$ in place of M. Because a step
   * starts from the last reactions this is the proximal point iteration
   * (Rockafellar, SIAM J. Control Optim. 14 (1976) 877-898): its limit solves
   * the problem with M itself, and of all reactions that do, those near the
   * estimate. Without units.
   */
  class ProximalNewton
  {
  public:
    using Array = Eigen::VectorXd;

    /** The relation must outlive this object. */
    explicit ProximalNewton(const SparseRelation &sparse_relation)
      : relation(sparse_relation)
    {}

    /**
     * Iterates p until the law holds to `goal` (see law_residual()) or nothing
     * is gained any more. Leaves the best point found, without the zeros of
     * its states. Returns its residual.
     */
    double
    polish(const double                 goal,
           const std::function<bool()> &stop,
           Array                       &p,
           Array                       &d);

    unsigned int
    n_factorizations() const
    {
      return factorizations;
    }

  private:
    bool
    direction(const Array &p, const Array &d, const double shift, Array &dp);
    bool
    step(const double shift, Array &p, Array &d, double &residual);

    const SparseRelation &relation;
    LargeFactor           factor;
    unsigned int          factorizations = 0;
  };
} // namespace conetact::solvers

#endif
