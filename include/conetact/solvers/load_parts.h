// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_load_parts_h
#define conetact_solvers_load_parts_h

#include "conetact/solvers/contact_problem.h"

#include <functional>

namespace conetact::solvers
{
  /** v = (0, gap): where an increment starts. */
  Eigen::VectorXd
  start_of(const ContactSystem &system, const Eigen::VectorXd &gap);

  /** How a solver goes through an increment part by part. */
  struct LoadParts
  {
    double smallest = 1; ///< part of the increment that is tried
    /** The limit of time, see SolverOptions. */
    std::function<bool()> stop = {};
    /** Gives a part that ends where `done` of the increment is done its load
     * and offset; what has `slipped` so far is part of them. */
    std::function<void(const double           done,
                       const Eigen::VectorXd &slipped,
                       ContactProblem        &part)>
      load;
    using Method = std::function<SolverReport(const ContactProblem &part,
                                              ContactState         &state)>;
    Method solve;
    /** Whether the end of a part is believed only where parts cannot be
     * smaller; none: all are. */
    std::function<bool(const ContactState &start, const ContactState &end)>
      is_doubtful = {};
    /** Whether so much more of the increment than what `last` bears is known
     * not to be held: it is not tried. */
    std::function<bool(const ContactState &last, const double more)>
      is_too_much = {};
    /** Tried once, where parts are as small as they may be; none: nothing is.
     */
    Method otherwise = {};
  };

  /** Of an increment: where so much more of it is too much, it is at its limit.
   */
  constexpr double next_to_limit = .002;

  /** Parts of an increment that begins with `state`, without a method. The
   * problem must outlive them. */
  LoadParts
  parts_from(const ContactState &state, const ContactProblem &problem);

  /**
   * Solves an increment in parts, which grow where they are solved and shrink
   * where not. The state is that at its start, v = (0, gap), and becomes that
   * at its end, with the slips of all parts, or that of the last one that was
   * solved (not of large systems).
   */
  SolverReport
  solve_in_parts(const LoadParts      &parts,
                 const ContactProblem &problem,
                 ContactState         &state);
} // namespace conetact::solvers

#endif
