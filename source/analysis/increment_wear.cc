// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Increments whose wear is accelerated, solved once more to see what that does.

#include "conetact/analysis/increment_analysis.h"

namespace conetact::analysis
{
  /* At its end, after half of what it wears. */
  void
  IncrementAnalysis::estimate_wear(const PendingIncrement &increment)
  {
    const contact::IncrementLaws *const laws = increment.load.laws.get();
    if (!wear_error.is_asked() || laws == nullptr)
      return;
    const Eigen::VectorXd worn =
      increment.after.worn() - increment.before.worn();
    Eigen::VectorXd after_half = worn;
    if (worn.size() > 0 && worn.maxCoeff() > 0)
      {
        contact::ContactHistory half = increment.before;
        half.wear_by(.5 * worn);
        const solvers::ContactProblem problem = half.problem(increment.load);
        solvers::ContactState         end     = half.start();
        end.node                              = increment.end.node;
        const solvers::SolverReport report =
          solver.solver_of_halves().solve(problem, end);
        done.add(report);
        if (!report.converged)
          return wear_error.miss();
        after_half = laws->wear(end);
      }
    wear_error.add(worn, after_half, increment.after.worn());
  }
} // namespace conetact::analysis
