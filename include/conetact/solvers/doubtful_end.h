// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_doubtful_end_h
#define conetact_solvers_doubtful_end_h

#include "conetact/solvers/contact_problem.h"

namespace conetact::solvers
{
  /**
   * Whether next to nothing is left of the reactions that pressed at the start,
   * less than `part` of the largest. Parts that let go may have left a jam that
   * the way through smaller parts keeps. Both are of contact unknowns.
   */
  bool
  lets_go(const Eigen::VectorXd &start,
          const Eigen::VectorXd &end,
          double                 part);

  /**
   * Whether bodies that float have moved so far beyond all gaps, given
   * displacements and deformations that rounding is what holds them: beyond a
   * limit, what is left of a null space in a matrix of rounded numbers still
   * balances a load, far away.
   */
  bool
  is_held_by_rounding(const ContactProblem &problem, const ContactState &end);
} // namespace conetact::solvers

#endif
