// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Increments that are not solved: sentences about those that have no
// equilibrium, and what else may solve them.

#include "conetact/analysis/increment_analysis.h"
#include "conetact/base/errors.h"
#include "conetact/base/team.h"
#include "conetact/contact/refusal.h"

#include <algorithm>

namespace conetact::analysis
{
  /* By contacts that are active. */
  std::string
  IncrementAnalysis::why_not_held(const solvers::ContactProblem &problem,
                                  const PendingIncrement        &increment)
  {
    const auto &laws = increment.load.laws;
    if (!laws)
      return "";
    std::vector<bool> active;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      active.push_back(laws->sees(i));
    if (std::find(active.begin(), active.end(), false) == active.end())
      return "";
    const Eigen::VectorXd load = model.elasticity().contact_load(problem);
    if (contact::drives_what_is_not_held(active, load, model))
      return "no equilibrium exists: loads drive a body that only contacts "
             "hold which are not active (Active = 0)";
    const auto result =
      contact::check_by(active,
                        load,
                        -increment.before.start().r.head(load.size()),
                        history.largest_force(),
                        model);
    return result && !result->admissible && laws->has_cones() ?
             "no equilibrium exists with the contacts that are active, " +
               describe(*result, model) :
             "";
  }

  std::string
  IncrementAnalysis::no_equilibrium(const solvers::ContactProblem &problem,
                                    const PendingIncrement        &increment)
  {
    if (problem.system->null_space.cols() == 0 ||
        problem.system->n_nodes() == 0)
      return "";
    if (const std::string why = why_not_held(problem, increment); !why.empty())
      return why;
    if (problem.laws) // its cones are others in each increment, or none
      existence.reset();
    if (!problem.has_cones())
      return "";
    if (!existence)
      existence = std::make_unique<solvers::ExistenceCheck>(
        contact::make_existence_check(model));
    // at the start of the increment the reactions balance the load on the null
    // space
    const solvers::Existence result =
      existence->check(model.elasticity().contact_load(problem),
                       -increment.before.start().r.head(
                         problem.system->n_contact_unknowns()),
                       history.largest_force(),
                       problem.gap);
    return result.admissible ?
             "" :
             std::string("no equilibrium exists") +
               // bodies that move have others
               (search.is_needed() ? " with contacts as they were found, " :
                                     ", ") +
               describe(result, model);
  }

  /* The way on was not found: what is known is that there must be one. */
  std::string
  IncrementAnalysis::why_it_leaves(const unsigned int k)
  {
    if (!lost_contacts)
      return "";
    if (const std::string why = take(search.guess(search.time())); !why.empty())
      return why;
    PendingIncrement increment{history, history};
    increment.record.increment = k;
    increment.record.time      = parts.end(scene.times[k - 1]);
    apply_loads(increment);
    const solvers::ContactProblem problem = history.problem(increment.load);
    if (problem.system->null_space.cols() == 0)
      return "";
    const auto here =
      contact::check_where_it_stands(problem.gap,
                                     model.elasticity().contact_load(problem),
                                     -history.start().r.head(
                                       problem.system->n_contact_unknowns()),
                                     history.largest_force(),
                                     model);
    return here && here->friction_needed ?
             failed(increment.record,
                    "no equilibrium exists where bodies stand at its start, " +
                      describe(*here, model) +
                      ", and none is found where they go from there") :
             "";
  }

  /* What slips or tips under the part of the load that was solved; empty: the
     method has failed otherwise. */
  std::string
  IncrementAnalysis::limit_of(const solvers::ContactProblem &problem,
                              const PendingIncrement        &increment)
  {
    const Eigen::Index n = problem.system->n_contact_unknowns();
    if (!existence || problem.system->large || increment.end.r.size() < n)
      return "";
    const Eigen::VectorXd    last = increment.end.r.head(n);
    const solvers::Existence limit =
      existence->limit_state(model.elasticity().contact_load(problem),
                             -increment.before.start().r.head(n),
                             last);
    return limit.admissible ?
             "" :
             "no equilibrium exists, " +
               describe_limit(limit, last, scene.contact_names, model);
  }

  void
  IncrementAnalysis::condense_from_here(const std::string &why)
  {
    leave_to_first();
    if (!is_in_team())
      return;
    log.say(why +
            " From here on bodies are condensed, which has more methods.");
    log.time("an increment that has not been solved");
    backend = backend->otherwise;
    model.solve_by(*backend->elasticity);
    existence.reset();
    solver = backend->create_solver(scene, model);
    forget_halves();
    try
      {
        make_elasticity();
      }
    catch (const InputError &error) // too late for one
      {
        throw AnalysisError(error.what());
      }
    history.see_elasticity();
  }
} // namespace conetact::analysis
