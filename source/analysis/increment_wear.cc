// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Increments whose wear is accelerated, solved twice more to see what that
// does.

#include "conetact/analysis/increment_analysis.h"

namespace conetact::analysis
{
  std::optional<contact::ContactHistory>
  IncrementAnalysis::after_half(contact::ContactHistory before,
                                const PendingIncrement &increment)
  {
    if (!solver_of_halves)
      solver_of_halves = backend->create_solver(scene, model);
    const auto        whole               = laws_from(before, increment);
    const auto        laws                = whole->with_wear(.5);
    contact::LoadCase load                = increment.load;
    load.laws                             = laws;
    const solvers::ContactProblem problem = before.problem(load);
    solvers::ContactState         end     = before.start();
    end.node                              = increment.end.node;
    const solvers::SolverReport report = solver_of_halves->solve(problem, end);
    done.add(report);
    if (!report.converged)
      return {};
    before.advance(end, increment.record.time, laws.get());
    return before;
  }

  /* The increment happens after half of its wear, and once more where that has
     worn: what wears then is what half of the acceleration makes of it.
     Contacts that are found again take the places of the run itself. */
  void
  IncrementAnalysis::estimate_wear(const PendingIncrement &increment)
  {
    if (!wear_error.is_asked() || !increment.load.laws)
      return;
    contact::ContactHistory before = increment.before;
    if (halves && !search.is_needed())
      before = *halves;
    else
      before.wear_by(wear_error.difference());
    halves = after_half(before, increment);
    if (halves)
      {
        before.wear_by(halves->worn() - before.worn());
        halves = after_half(std::move(before), increment);
      }
    if (!halves)
      return wear_error.miss();
    wear_error.set(increment.after.worn(), halves->worn());
  }
} // namespace conetact::analysis
