// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_friction_limit_h
#define conetact_solvers_friction_limit_h

#include <Eigen/Core>

namespace conetact::solvers
{
  /** How much friction a node has, |r_t| <= value, and how that changes. */
  struct FrictionLimit
  {
    double value    = 0; ///< [force]
    double by_force = 0; ///< with the normal reaction [-]
    double by_slip  = 0; ///< with the slip of the increment [force/length]
  };

  /**
   * Friction of an increment that is not one coefficient a node for all of
   * them. @f$|r_t| \le f(r_n, |\Delta u_t|)@f$, and what slips has
   * @f$r_t = -f\,\Delta u_t/|\Delta u_t|@f$: f takes the place of
   * @f$\mu r_n@f$ everywhere, so that no solver needs a cone that is none.
   * f(0, .) = 0.
   */
  class VaryingFriction
  {
  public:
    virtual ~VaryingFriction() = default;

    /** What does not press, r_n <= 0, has the slope of r_n = 0. */
    virtual FrictionLimit
    at(const Eigen::Index node, const double r_n, const double slip) const = 0;

    /** Whether it is a coefficient a node, known before anything is solved. */
    virtual bool
    is_known() const = 0;
  };
} // namespace conetact::solvers

#endif
