// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/wear_comparison.h"

#include <utility>

namespace conetact::analysis
{
  WearComparison::WearComparison(RunContext &r, const bool change)
    : error(r.model.points)
    , run(r)
    , contacts_change(change)
  {}

  void
  WearComparison::see_elasticity()
  {
    const auto &now = run.model.elasticity().system();
    if (system == now && solver)
      return;
    system = now;
    solver = run.backend->create_solver(run.scene.solver, run.scene, run.model);
    history.reset();
  }

  std::optional<contact::ContactHistory>
  WearComparison::after_half(contact::ContactHistory before,
                             const PendingIncrement &increment)
  {
    const auto        whole               = run.laws_from(before, increment);
    const auto        laws                = whole->with_wear(.5);
    contact::LoadCase load                = increment.load;
    load.laws                             = laws;
    const solvers::ContactProblem problem = before.problem(load);
    solvers::ContactState         end     = before.start();
    end.node                              = increment.end.node;
    const solvers::SolverReport report    = solver->solve(problem, end);
    run.done.add(report);
    if (!report.converged)
      return {};
    before.advance(end, increment.record.time, laws.get());
    return before;
  }

  void
  WearComparison::add(const PendingIncrement &increment)
  {
    if (!error.is_asked() || !increment.load.laws)
      return;
    see_elasticity();
    contact::ContactHistory before = increment.before;
    if (history && !contacts_change)
      before = *history;
    else
      before.wear().add_difference(error.difference(),
                                   error.difference_of_sides(),
                                   run.model.points);
    history = after_half(before, increment);
    if (history)
      {
        before.wear().take(history->memory().wear, run.model.points);
        history = after_half(std::move(before), increment);
      }
    if (history)
      error.set(increment.after.memory().wear, history->memory().wear);
    else
      error.miss();
  }
} // namespace conetact::analysis
