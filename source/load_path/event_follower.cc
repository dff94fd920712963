// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/event_follower.h"

#include "conetact/solvers/solver_table.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Rates below this share of the largest are round-off. */
    constexpr double rate_noise = 1e-14, motion_noise = 1e-9;
    /** An event this close behind the end of a stage, in its length, counts. */
    constexpr double beyond_end = 1e-12;
    /** Steps beyond a point without continuation, in the length of the stage.
     */
    constexpr double jump_steps[] = {1e-8, 1e-6, 1e-4};
  } // namespace



  EventFollower::EventFollower(std::shared_ptr<const solvers::ContactSystem> s,
                               const VectorXd    &gap,
                               const PathOptions &o)
    : contact(std::move(s))
    , options(o)
    , system(*contact, options.cohesion)
    , ratio_test(system, options.law)
    , now{Scheme(static_cast<std::size_t>(system.n_nodes())),
          VectorXd::Zero(system.size()),
          VectorXd::Zero(system.size()),
          VectorXd::Zero(system.size()),
          {}}
  {
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index n = system.normal[static_cast<std::size_t>(i)];
        now.v(n)      = gap(i) / system.scale(n);
      }
    // f = K (0, gap): in balance without any reaction.
    now.load   = system.K * now.v;
    last.v     = system.scale.cwiseProduct(now.v);
    last.r     = now.r;
    last.state = path_states(system, now.scheme);
  }



  /* A jump of the load between stages would be an increment, not a path. */
  void
  EventFollower::check_start(const PathStage &s) const
  {
    const VectorXd start = system.scale.cwiseProduct(s.load);
    if (solvers::largest(start - now.load) >
        1e-9 * std::max(solvers::largest(start), solvers::largest(now.load)))
      throw std::invalid_argument(
        "A stage of a load path must start with the loads that the stage "
        "before it ended with, the first one with none but K (0, gap).");
    if (!(s.end > s.begin))
      throw std::invalid_argument("A stage of a load path must have a length.");
  }



  /** Takes the decision of a rate problem. */
  void
  EventFollower::take(Rates &rates)
  {
    now.scheme = rates.scheme;
    factor     = std::move(rates.factor);
    if (options.law == PathLaw::holonomic)
      for (std::size_t i = 0; i < now.scheme.size(); ++i)
        if (system.tangent[i] >= 0 && now.scheme[i].slip == 0 &&
            !system.is_free(static_cast<Index>(i), now.scheme[i].closed))
          // Stuck under the holonomic law means no slip in total.
          now.v(system.tangent[i]) = 0;
    // Those of a mechanism are those of the scheme before it.
    if (rates.outcome == RateOutcome::found)
      factor.values(now.load, now.v, now.r);
  }



  void
  EventFollower::move_to(const double p, const VectorXd &v_rate)
  {
    // An estimate only: v and r follow anew from the scheme, so that errors do
    // not gather from event to event.
    now.v += (p - parameter) * v_rate;
    parameter = p;
    now.load =
      system.scale.cwiseProduct(stage.load + (p - stage.begin) * stage.rate);
    factor.values(now.load, now.v, now.r);
  }



  /** Follows a mechanism until it stops; false: it never does. */
  bool
  EventFollower::move_at_constant_load(const VectorXd &velocity)
  {
    // The parameter stands still: the step is one of the motion. Reactions keep
    // their values, only gaps close and slips end.
    const PathEvents stops =
      RatioTest::first(ratio_test.events(now,
                                         velocity,
                                         VectorXd::Zero(now.r.size()),
                                         motion_noise),
                       0);
    if (stops.empty())
      return false;
    const double step = stops.front().step;
    if (step * solvers::largest(velocity) >
        value_tolerance * solvers::largest(now.v))
      {
        now.v += step * velocity;
        plateau      = true;
        now.critical = ratio_test.critical_nodes(now);
      }
    ratio_test.add(stops, now);
    return true;
  }



  /**
   * Solves the whole problem from where the path stands, at a parameter just
   * beyond, and takes the states of the result.
   */
  bool
  EventFollower::solve_beyond(const double p, std::string &reason)
  {
    VectorXd                slipped = system.scale.cwiseProduct(now.v);
    solvers::ContactState   state;
    solvers::ContactProblem problem;
    state.v        = slipped;
    state.r        = now.r.cwiseQuotient(system.scale);
    problem.system = contact;
    problem.gap.resize(system.n_nodes());
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index n  = system.normal[static_cast<std::size_t>(i)];
        problem.gap(i) = std::max(0., slipped(n));
        slipped(n)     = 0;
      }
    state.v -= slipped;
    // K (slipped + v) = r + f with the law on v alone.
    problem.load =
      stage.load + (p - stage.begin) * stage.rate - contact->matrix * slipped;
    solvers::SolverOptions solver_options;
    solver_options.tolerance = options.tolerance;
    const solvers::SolverReport report =
      solvers::make_solver(solver_options)->solve(problem, state);
    reason = report.reason;
    if (!report.converged)
      return false;
    for (std::size_t i = 0; i < now.scheme.size(); ++i)
      {
        const Index t        = system.tangent[i];
        now.scheme[i].closed = state.node[i] != solvers::NodeState::open;
        now.scheme[i].slip   = 0;
        if (t >= 0 && state.node[i] == solvers::NodeState::slip)
          now.scheme[i].slip = state.v(t) > 0 ? 1 : -1;
      }
    now.v = (slipped + state.v).cwiseQuotient(system.scale);
    // Where the result is a mechanism in balance, rigid motions are held
    // softly.
    factor = SchemeFactor(system, now.scheme, false);
    if (!factor.regular())
      factor = SchemeFactor(system, now.scheme, true);
    return true;
  }



  /**
   * Over a gap of the path to another equilibrium, at the same load if its
   * states hold there, else at the one just beyond for which it was found.
   */
  bool
  EventFollower::jump(const PathVisitor &visit, PathResult &result)
  {
    result.reason = "The path has no continuation at this load, and with "
                    "cohesion there is no way to jump over the gap.";
    if (system.cohesion.maxCoeff() > 0)
      return false;
    if (parameter > last.parameter)
      emit(visit, true);
    const double   from     = parameter;
    const VectorXd v_before = now.v, r_before = now.r;
    const Scheme   scheme_before = now.scheme;
    std::string    reason;
    for (const double step : jump_steps)
      {
        const double beyond = from + step * (stage.end - stage.begin);
        if (solve_beyond(beyond, reason))
          {
            // Best at the load where the path broke off: then nothing is
            // skipped.
            for (const double p : {from, beyond})
              {
                move_to(p, VectorXd::Zero(now.v.size()));
                if (here().residual <= options.tolerance)
                  {
                    jumped       = true;
                    now.critical = ratio_test.critical_nodes(now);
                    result.reason.clear();
                    return true;
                  }
              }
            reason = "an equilibrium was found in several steps only.";
          }
        now.v      = v_before;
        now.r      = r_before;
        now.scheme = scheme_before;
        parameter  = from;
      }
    result.reason = "The path has no continuation at this load, and a full "
                    "solve found no other equilibrium: " +
                    reason;
    return false;
  }



  PathResult
  EventFollower::end_without_rates(PathResult result)
  {
    // A path that goes on with falling loads has a turning point here. The
    // holonomic law remembers no slip: it is the same path.
    const VectorXd backward = system.scale.cwiseProduct(-stage.rate);
    const Rates    back =
      solve_rate_problem(system, now.scheme, now.critical, backward);
    if (back.outcome == RateOutcome::found)
      result.outcome = PathOutcome::turning_point;
    else
      result.reason = "The path has no continuation at this load, neither with "
                      "growing nor with falling loads.";
    return result;
  }



  /** Where the path stands, as a point after the last one. */
  PathPoint
  EventFollower::here() const
  {
    PathPoint point;
    point.parameter = parameter;
    point.v         = system.scale.cwiseProduct(now.v);
    point.r         = now.r.cwiseQuotient(system.scale);
    point.plateau   = plateau;
    point.jump      = jumped;
    point.state     = path_states(system, now.scheme);
    for (std::size_t i = 0; i < point.state.size(); ++i)
      if (point.state[i] != last.state[i])
        point.changes.push_back(
          {static_cast<Index>(i), last.state[i], point.state[i]});
    point.residual = path_residual(
      *contact, options, now.load.cwiseQuotient(system.scale), last, point);
    return point;
  }



  /** Shows where the path stands, if a state has changed or always. */
  void
  EventFollower::emit(const PathVisitor &visit, const bool always)
  {
    PathPoint point = here();
    if (point.changes.empty() && !always && !plateau && !jumped)
      return;
    plateau = jumped = false;
    if (visit)
      visit(point);
    last = std::move(point);
  }



  PathResult
  EventFollower::follow(const PathStage &s, const PathVisitor &visit)
  {
    check_start(s);
    stage     = s;
    parameter = last.parameter = stage.begin;
    const VectorXd load_rate   = system.scale.cwiseProduct(stage.rate);
    const double   length      = stage.end - stage.begin;
    now.critical               = ratio_test.critical_nodes(now);

    PathResult   result;
    unsigned int jumps = 0;
    // Degenerate events could repeat at one load.
    const std::size_t most_events = 1000 + 100 * now.scheme.size();
    for (std::size_t k = 0; k < most_events; ++k)
      {
        result.parameter = parameter;
        ratio_test.turn_closing_nodes(now);
        Rates rates =
          solve_rate_problem(system, now.scheme, now.critical, load_rate);
        if (rates.outcome == RateOutcome::none)
          {
            if (options.law == PathLaw::holonomic)
              return end_without_rates(result);
            // Jumps that only lead to further ones do not lead on.
            if (++jumps > 3 || !jump(visit, result))
              return result;
            continue;
          }
        take(rates);
        if (rates.outcome == RateOutcome::mechanism)
          {
            emit(visit, false);
            if (move_at_constant_load(rates.v))
              continue;
            result.outcome   = PathOutcome::limit_load;
            result.mechanism = system.scale.cwiseProduct(rates.v);
            result.mechanism /= solvers::largest(result.mechanism);
            return result;
          }

        const double     so_far = parameter - stage.begin;
        const PathEvents first =
          RatioTest::first(ratio_test.events(now, rates.v, rates.r, rate_noise),
                           so_far);
        const double step = first.empty() ? 0. : first.front().step;
        // What follows at once belongs to the same event.
        if (RatioTest::are_now(first, so_far) && ratio_test.add(first, now))
          continue;
        emit(visit, false);
        jumps = 0;
        // Without any event ahead the states hold for all larger loads. That is
        // no limit load.
        if (first.empty() || parameter + step > stage.end + beyond_end * length)
          {
            move_to(stage.end, rates.v);
            emit(visit, true);
            result.parameter = parameter;
            result.outcome   = first.empty() ? PathOutcome::no_further_change :
                                               PathOutcome::target_reached;
            return result;
          }
        move_to(std::min(parameter + step, stage.end), rates.v);
        now.critical = ratio_test.critical_nodes(now);
        ratio_test.add(first, now);
      }
    result.reason = "The states of contact change without end at this load.";
    return result;
  }



  std::unique_ptr<PathFollower>
  make_event_follower(std::shared_ptr<const solvers::ContactSystem> system,
                      const Eigen::VectorXd                        &gap,
                      const PathOptions                            &options)
  {
    return std::make_unique<EventFollower>(std::move(system), gap, options);
  }
} // namespace conetact::load_path
