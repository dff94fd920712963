// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/equilibrium_check.h"

#include "conetact/application/method_checks.h"
#include "conetact/contact/refusal.h"
#include "conetact/solvers/doubtful_end.h"

#include <algorithm>

namespace conetact::analysis
{
  namespace
  {
    /** Whether the check can be asked about them: not of large systems. */
    bool
    has_contact_reactions(const solvers::ContactProblem &problem,
                          const Eigen::VectorXd         &r)
    {
      return !problem.system->large &&
             r.size() >= problem.system->n_contact_unknowns();
    }

    /** What has let go of all that pressed holds no more: that is no limit. */
    constexpr double gone = 1e-6;

    /** Whether supports may have been released, or added, at its start. */
    bool
    begins_stage(const PendingIncrement &increment, const RunContext &run)
    {
      return run.scene.restart &&
             increment.record.increment == run.scene.n_done() + 1;
    }

    /** The loads at its start: what supports held that are released is none. */
    Eigen::VectorXd
    loads_at_start(const PendingIncrement &increment, RunContext &run)
    {
      PendingIncrement start{increment.before, increment.before};
      start.record.time = run.acceptance.accepted_time();
      run.apply_loads(start);
      if (const auto &laws = increment.load.laws)
        run.model.points.set_friction(laws->coefficients(run.history.start()));
      return run.model.elasticity().contact_load(
        start.before.problem(start.load));
    }

    bool
    could_follow_path(const application::Scene &scene)
    {
      return !scene.restart && scene.stages.ends(scene.times).size() < 2 &&
             application::may_follow_path(scene, scene);
    }

    /**
     * Of each body, whether nothing acts on it: neither loads nor supports that
     * strain it, nor contacts. What is bound may act.
     */
    std::vector<bool>
    are_idle(const PendingIncrement      &increment,
             const contact::ContactModel &model)
    {
      const model::Bodies &bodies = model.bodies;
      std::vector<bool>    idle(bodies.structures.size(), true);
      const auto acts = [&](const Eigen::VectorXd &x, const unsigned int body) {
        const Eigen::Index first = model.coordinates.offset(body);
        const Eigen::Index n     = model.coordinates.offset(body + 1) - first;
        return x.size() > 0 && !x.segment(first, n).isZero(0);
      };
      for (unsigned int body = 0; body < idle.size(); ++body)
        idle[body] = !acts(*increment.forces, body) &&
                     !acts(increment.load.prescribed, body);
      // What may move by itself has a place, not only a deformation.
      const Eigen::MatrixXd &free = model.motions.free();
      const Eigen::Index     n_one =
        free.rows() / static_cast<Eigen::Index>(idle.size());
      for (unsigned int body = 0; body < idle.size(); ++body)
        if (!free.middleRows(body * n_one, n_one).isZero(0))
          idle[body] = false;
      // Foundations act as far as bodies move.
      for (const bodies::Support &support : bodies.supports)
        if (support.stiffness)
          idle[support.body] = false;
      for (std::size_t i = 0; i < model.points.all().size(); ++i)
        {
          const contact::ContactPoint &point = model.points.all()[i];
          const pairing::ContactNode  &node  = *point.node;
          const auto n = static_cast<Eigen::Index>(point.dual.size());
          if (i < model.points.size() && !node.opening &&
              increment.end.r.segment(point.first, n).isZero(0))
            continue;
          idle[node.body] = false;
          if (!node.masters.empty())
            idle[node.master] = false;
        }
      return idle;
    }
  } // namespace

  void
  rest_idle_bodies(PendingIncrement &increment, contact::ContactModel &model)
  {
    const contact::Elasticity &elastic = model.elasticity();
    if (!elastic.system()->large || increment.end.v.size() == 0)
      return;
    const std::vector<bool> idle = are_idle(increment, model);
    if (std::find(idle.begin(), idle.end(), true) == idle.end())
      return;
    solvers::ContactState &end = increment.end;
    Eigen::VectorXd        w   = elastic.states().deformation(end.u);
    for (unsigned int body = 0; body < idle.size(); ++body)
      if (!idle[body])
        {
          const Eigen::Index first = model.coordinates.offset(body);
          w.segment(first, model.coordinates.offset(body + 1) - first)
            .setZero();
        }
    const Eigen::VectorXd less =
      elastic.states().nearby(w, Eigen::VectorXd::Zero(model.motions.n_free()));
    end.u -= less;
    end.v -= less.tail(end.v.size());
  }

  EquilibriumCheck::EquilibriumCheck(RunContext &r, const bool change)
    : run(r)
    , contacts_change(change)
  {}

  Eigen::VectorXd
  EquilibriumCheck::load_at_start(const solvers::ContactProblem &problem,
                                  const contact::ContactHistory &before)
  {
    return -before.start().r.head(problem.system->n_contact_unknowns());
  }

  std::string
  EquilibriumCheck::refusal_by_active(const solvers::ContactProblem &problem,
                                      const PendingIncrement        &increment)
  {
    const auto &laws = increment.load.laws;
    if (!laws)
      return "";
    std::vector<bool> active;
    for (std::size_t i = 0; i < run.model.points.size(); ++i)
      active.push_back((*laws)[i].sees());
    if (std::find(active.begin(), active.end(), false) == active.end())
      return "";
    const Eigen::VectorXd load = run.model.elasticity().contact_load(problem);
    if (contact::drives_what_is_not_held(active, load, run.model))
      return "no equilibrium exists: loads drive a body that only contacts "
             "hold which are not active (Active = 0)";
    const auto result =
      contact::check_by(active,
                        load,
                        load_at_start(problem, increment.before),
                        run.history.largest_force(),
                        run.model);
    return result && !result->admissible && laws->has_cones() ?
             "no equilibrium exists with the contacts that are active, " +
               describe(*result, run.model, *increment.mechanical) :
             "";
  }

  std::string
  EquilibriumCheck::refusal(const solvers::ContactProblem &problem,
                            const PendingIncrement        &increment)
  {
    if (problem.system->null_space.cols() == 0 ||
        problem.system->n_nodes() == 0)
      return "";
    if (const std::string why = refusal_by_active(problem, increment);
        !why.empty())
      return why;
    const auto &laws = increment.load.laws;
    if (laws) // cones are others in each increment, or none
      reset();
    const bool may_pull = problem.has_bonds();
    if (!existence)
      existence = std::make_unique<solvers::ExistenceCheck>(
        contact::make_existence_check(run.model,
                                      laws && !may_pull ?
                                        laws->largest_coefficients() :
                                        run.model.points.layout().mu));
    if (may_pull)
      return "";
    const Eigen::VectorXd load = run.model.elasticity().contact_load(problem);
    const auto            check_from = [&](const Eigen::VectorXd &start) {
      return existence->check(load,
                              start,
                              run.history.largest_force(),
                              problem.gap);
    };
    solvers::Existence result =
      check_from(load_at_start(problem, increment.before));
    if (!result.admissible && begins_stage(increment, run))
      result = check_from(loads_at_start(increment, run));
    return result.admissible ?
             "" :
             std::string("no equilibrium exists") +
               (contacts_change ? " with contacts as they were found, " :
                                  ", ") +
               describe(result, run.model, *increment.mechanical) +
               (problem.has_cones() ?
                  "" :
                  ", by the largest coefficients that its laws allow");
  }

  solvers::Holding
  EquilibriumCheck::holding(const PendingIncrement &increment,
                            const Eigen::VectorXd  &r) const
  {
    if (increment.load.laws)
      return increment.load.laws->holding(r);
    return solvers::ExistenceCheck::holding_of_cones(run.model.points.layout(),
                                                     r);
  }

  std::optional<solvers::Existence>
  EquilibriumCheck::limit_state(const solvers::ContactProblem &problem,
                                const PendingIncrement        &increment,
                                const Eigen::VectorXd         &r,
                                const double                   ahead) const
  {
    const Eigen::Index    n     = problem.system->n_contact_unknowns();
    const Eigen::VectorXd start = load_at_start(problem, increment.before);
    if (!existence || !has_contact_reactions(problem, r) ||
        solvers::lets_go(start, r.head(n), gone))
      return {};
    Eigen::VectorXd       load = run.model.elasticity().contact_load(problem);
    const Eigen::VectorXd way  = load - start;
    if (ahead > 0 && way.norm() > 0)
      load += ahead * load.norm() / way.norm() * way;
    const solvers::Existence limit = existence->limit_state(
      load, start, r.head(n), [&](const Eigen::VectorXd &at) {
        return holding(increment, at);
      });
    return limit.admissible ? std::nullopt : std::optional(limit);
  }

  bool
  EquilibriumCheck::is_limit(const solvers::ContactProblem &problem,
                             const PendingIncrement        &increment,
                             const Eigen::VectorXd         &r,
                             const double                   more) const
  {
    const Eigen::Index    n     = problem.system->n_contact_unknowns();
    const Eigen::VectorXd start = load_at_start(problem, increment.before);
    return existence && has_contact_reactions(problem, r) &&
           !solvers::lets_go(start, r.head(n), gone) &&
           existence->is_limit(
             run.model.elasticity().contact_load(problem),
             start,
             r.head(n),
             [&](const Eigen::VectorXd &at) { return holding(increment, at); },
             more);
  }

  std::string
  EquilibriumCheck::limit(const solvers::ContactProblem &problem,
                          const PendingIncrement        &increment) const
  {
    const auto found = limit_state(problem, increment, increment.end.r);
    if (!found)
      return "";
    const std::vector<bool> &wet = increment.wet;
    if (std::find(wet.begin(), wet.end(), true) != wet.end())
      return "no equilibrium exists, " +
             describe_motion(*found, run.model, *increment.mechanical) +
             ", as fluids press it. Apply less pressure, or more load against "
             "it";
    // From nothing on shares of a load are like all of it.
    constexpr double none = 1e-4; // a share that would be told as that
    if (found->fraction < none &&
        load_at_start(problem, increment.before).isZero(0))
      return "no equilibrium was found, not even under the smallest part of "
             "this increment's load, with which " +
             describe_motion(*found, run.model, *increment.mechanical) +
             ". Less of the same load does not help: hold this motion by more "
             "friction, by supports or by other loads";
    const Eigen::VectorXd last =
      increment.end.r.head(problem.system->n_contact_unknowns());
    return "no equilibrium exists, " +
           describe_limit(*found,
                          last,
                          holding(increment, last).friction,
                          run.scene.contact_names,
                          run.model,
                          *increment.mechanical) +
           (could_follow_path(run.scene) ?
              ", or let Solver/Method = load path find the limit" :
              "");
  }

  std::string
  EquilibriumCheck::limit_ahead(const solvers::ContactProblem &problem,
                                const PendingIncrement        &increment) const
  {
    constexpr double little = .01;
    const auto found = limit_state(problem, increment, increment.end.r, little);
    if (found)
      return "; this is within 1 % of the load from which on " +
             describe_motion(*found, run.model, *increment.mechanical);
    if (!existence || !has_contact_reactions(problem, increment.end.r))
      return "";
    const Eigen::VectorXd last =
      increment.end.r.head(problem.system->n_contact_unknowns());
    const std::string slips =
      contact::what_slips(last,
                          holding(increment, last).friction,
                          run.scene.contact_names,
                          run.model);
    return slips.empty() ?
             "" :
             "; there " + slips +
               ", and bodies may jump from there to where nothing shows the "
               "way. Apply less load, or move bodies by supports";
  }

  std::string
  EquilibriumCheck::refusal_where_it_stands(const PendingIncrement &increment)
  {
    const solvers::ContactProblem problem = run.history.problem(increment.load);
    if (problem.system->null_space.cols() == 0)
      return "";
    const auto here =
      contact::check_where_it_stands(problem.gap,
                                     run.model.elasticity().contact_load(
                                       problem),
                                     load_at_start(problem, run.history),
                                     run.history.largest_force(),
                                     run.model);
    return here && here->friction_needed ?
             "no equilibrium exists where bodies stand at its start, " +
               describe(*here, run.model, *increment.mechanical) +
               ", and none is found where they go from there" :
             "";
  }
} // namespace conetact::analysis
