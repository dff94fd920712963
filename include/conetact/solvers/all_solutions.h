// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_all_solutions_h
#define conetact_solvers_all_solutions_h

#include "conetact/solvers/contact_problem.h"

#include <string>
#include <vector>

namespace conetact::solvers
{
  /** The solutions of an increment in the plane. */
  struct AllSolutions
  {
    std::vector<ContactState> found;
    std::size_t               n_tried = 0; ///< sets of states, most of them
                                           ///< of some nodes only
    /** Why there may be others; empty: there are none. */
    std::string open;
  };

  /** Whether its solutions are those of finitely many linear problems: nodes
   * have one tangent at most, bodies are held, and nothing is too large. */
  bool
  has_finite_solutions(const ContactProblem &problem);

  /**
   * All solutions of a problem whose nodes have one tangent at most and cones.
   * Each node is open, sticks, or slips either way, which makes the problem
   * linear. Sets of states are tried node by node: those that a convex
   * quadratic problem excludes, with all of their completions, are left out.
   * With v = W r + q every solution has
   * @f[ r^T W r + q^T r = \sum_i r_i \cdot v_i \le 0 @f]
   * (open nodes have no reaction, closed ones no gap, friction opposes slips)
   * on the polyhedron of those conditions of the states that are linear, so
   * that what makes this positive there cannot be completed. Without friction
   * one set is left; with more friction more remain, and at most `most` are
   * tried.
   * The problem must have finitely many.
   */
  AllSolutions
  find_all_solutions(const ContactProblem &problem,
                     const double          tolerance,
                     const std::size_t     most = 20000);
} // namespace conetact::solvers

#endif
