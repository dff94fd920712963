// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Fluids that get between the sides of contacts within an increment.

#include "conetact/analysis/increment_analysis.h"

#include <utility>

namespace conetact::analysis
{
  bool
  IncrementAnalysis::fluid_enters(PendingIncrement &increment)
  {
    if (!fluid)
      fluid.emplace(model.bodies, model.points);
    if (fluid->is_none())
      return false;
    increment.wet.resize(model.points.size(), false);
    std::vector<bool> wet = fluid->wet(increment.wet,
                                       increment.end.r,
                                       model.points,
                                       increment.record.time);
    if (wet == increment.wet)
      return false;
    increment.wet = std::move(wet);
    set_laws(increment);
    return true;
  }

  void
  IncrementAnalysis::say_leaks(const PendingIncrement &increment)
  {
    if (increment.wet.empty())
      return;
    for (const unsigned int contact : fluid->leaks(increment.wet, model.points))
      if (said_leaks.insert(contact).second)
        log.note("increment " + std::to_string(increment.record.increment) +
                 ": contact '" + scene.contact_names[contact] +
                 "' leaks: its fluid has reached an edge that is no source of "
                 "it and that no support holds");
  }

  /* What is wet stays so in the increment: the repetitions end. */
  void
  IncrementAnalysis::let_fluid_in(PendingIncrement            &increment,
                                  const solvers::ContactState &guess,
                                  solvers::ContactProblem     &problem)
  {
    solvers::ContactState &state  = increment.end;
    solvers::SolverReport &report = increment.record.report;
    while (report.converged && fluid_enters(increment))
      {
        const solvers::ContactState dry = std::exchange(state, guess);
        state.r                         = dry.r;
        state.node                      = dry.node;
        problem                         = history.problem(increment.load);
        solvers::SolverReport wet       = solver->solve(problem, state);
        done.add(wet);
        add_work(wet, report);
        report = wet;
      }
  }
} // namespace conetact::analysis
