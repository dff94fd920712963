// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/reproductions/published_smoothing.h"

#include "conetact/solvers/smoothing_iteration.h"
#include "conetact/solvers/stiffness_form.h"

namespace conetact::reproductions
{
  namespace
  {
    solvers::SmoothingOptions
    options_of(const PublishedSet &set)
    {
      solvers::SmoothingOptions options;
      options.kappa  = 1;
      options.eta    = set.eta;
      options.etabar = set.etabar;
      options.m0 = options.eps0 = set.m0;
      options.beta0             = set.beta0;
      options.precision         = 0;
      options.smallest_m        = 1e-16; // m divides
      options.smallest_eps      = 0;
      options.frozen_pivot      = 0;
      return options;
    }
  } // namespace



  const std::vector<PublishedSet> &
  published_sets()
  {
    static const std::vector<PublishedSet> sets = {{"A", .9, .5, 1e-3, 1},
                                                   {"B", .5, .1, .1, 100}};
    return sets;
  }



  PublishedRun
  solve_as_published(const solvers::ContactProblem &problem,
                     const PublishedSet            &set,
                     const double                   tolerance)
  {
    // the paper's form, in which free motions are no unknowns of their own
    if (problem.system->n_motions > 0)
      {
        const solvers::StiffnessForm form(problem.system);
        if (form.exists())
          return solve_as_published(form.eliminate(problem), set, tolerance);
      }
    solvers::LinearRelation relation(problem.system, false);
    relation.set_load(problem);
    solvers::ContactState state;
    state.v = state.r = Eigen::VectorXd::Zero(problem.system->n_unknowns());
    solvers::SmoothingIteration iteration(relation, options_of(set), state);
    PublishedRun                run;
    if (!iteration.advance(tolerance))
      run.failure = iteration.failure();
    iteration.get(state);
    run.iterations = iteration.n_iterations();
    run.natural    = iteration.residual();
    run.errors     = solvers::kanno_errors(problem, state);
    run.residual   = solvers::contact_residual(problem, state);
    return run;
  }
} // namespace conetact::reproductions
