// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/smoothing_newton.h"

#include "conetact/solvers/fixed_cones.h"

namespace conetact::solvers
{
  SmoothingNewton::SmoothingNewton(const SolverOptions &solver_options)
    : options(solver_options)
    , active_set(solver_options)
  {}



  SolverReport
  SmoothingNewton::solve(const ContactProblem &problem, ContactState &state)
  {
    if (!relation || !relation->is(problem.system))
      relation.emplace(problem.system);
    relation->set_load(problem);

    SmoothingOptions smoothing = options.smoothing;
    smoothing.stop             = options.stop;
    SmoothingIteration iteration(*relation, smoothing, state);
    // The residual of the iteration is relative to the largest load, which
    // may be smaller than the reactions: the check below is what counts.
    iteration.advance(options.tolerance);
    SolverReport report;
    report.iterations     = iteration.n_iterations();
    report.factorizations = iteration.n_factorizations();
    iteration.get(state);
    finish(problem, state, report);
    if (!report.converged)
      report.reason = iteration.failure().empty() ?
                        "the contact residual is above the tolerance" :
                        iteration.failure();
    return report;
  }



  /** Makes zeros exact, if an active set step can, and takes the measure. */
  void
  SmoothingNewton::finish(const ContactProblem &problem,
                          ContactState         &state,
                          SolverReport         &report)
  {
    ContactState exact = state;
    SolverReport polish;
    if (state.v.allFinite() && state.r.allFinite())
      polish = active_set.polish(problem, exact);
    report.iterations += polish.iterations;
    report.factorizations += polish.factorizations;
    if (polish.converged)
      state = exact;
    else
      state.node = classify(problem, state, 1e-8);
    report.residual  = contact_residual(problem, state);
    report.converged = report.residual <= options.tolerance;
    if (report.converged)
      report.solver = "smoothing";
  }



  std::unique_ptr<ContactSolver>
  make_smoothing_newton(const SolverOptions &options)
  {
    return with_fixed_cones(std::make_unique<SmoothingNewton>(options),
                            options);
  }
} // namespace conetact::solvers
