// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_without_fall_h
#define conetact_solvers_without_fall_h

#include "conetact/solvers/contact_problem.h"

namespace conetact::solvers
{
  /**
   * The same problem, whose friction falls neither with the slip nor, as a
   * coefficient, with pressure: each step sees cones of the point where it
   * starts. Where friction falls faster than bodies resist, Newton's method
   * goes the wrong way; with these slopes slips grow from step to step until
   * friction holds them. Limits are those of the laws themselves.
   */
  ContactProblem
  without_fall(const ContactProblem &problem);

  /** Whether friction of any node grows with the slip from rest on. */
  bool
  grows_from_rest(const ContactProblem &problem);

  /** The same problem, whose friction sees that part of slips only: what grows
   * steeply with them grows so much more gently. */
  ContactProblem
  with_slower_slip(const ContactProblem &problem, const double part);
} // namespace conetact::solvers

#endif
