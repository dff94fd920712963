// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_reach_h
#define conetact_solvers_reach_h

#include "conetact/solvers/contact_problem.h"

#include <Eigen/Dense>

#include <limits>

namespace conetact::solvers
{
  /** A friction coefficient that means "no slip whatever the reaction". */
  constexpr double no_slip_friction = std::numeric_limits<double>::infinity();

  /** z = R^T r + c of smallest length, and the reactions r in their cones. */
  struct Reach
  {
    Eigen::VectorXd z, r;
  };

  /**
   * How near reactions in the friction cones of `layout` (with the
   * coefficients mu instead of its own) come to balancing the resultants c on
   * the motions R, orthonormal columns:
   * @f[ z = R^T r + c, \quad |z| \to \min \text{ over } r \in C . @f]
   * Then @f$v = R z@f$ has @f$v_n \ge \mu |v_t|@f$ at all nodes. c and r in
   * units of force.
   *
   * Method: proximal point iteration on r; each step is a strongly convex
   * problem in z, as small as the number of motions, solved by a semismooth
   * Newton method (Rockafellar, Math. Oper. Res. 1 (1976) 97-116; Qi, Sun,
   * Math. Program. 58 (1993) 353-367).
   */
  Reach
  nearest_reach(const ContactSystem   &layout,
                const Eigen::MatrixXd &R,
                const Eigen::VectorXd &c,
                const Eigen::VectorXd &mu);

  /** What nodes bear, -pull <= r_n <= push and |r_t| <= friction, which r_n
   * does not change [force]. */
  struct Holding
  {
    Eigen::VectorXd friction, pull, push; ///< of each node; may be infinite
  };

  /** The same of reactions in these cylinders. */
  Reach
  nearest_reach(const ContactSystem   &layout,
                const Eigen::MatrixXd &R,
                const Eigen::VectorXd &c,
                const Holding         &holding);
} // namespace conetact::solvers

#endif
