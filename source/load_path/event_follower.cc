// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/event_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
    /** Displacements that differ by less, in the largest, are the same. */
    constexpr double same_state = 1e-9;
    /** Jumps in a row, under one load. */
    constexpr unsigned int most_jumps = 10;
  } // namespace



  EventFollower::EventFollower(std::shared_ptr<const solvers::ContactSystem> s,
                               const VectorXd    &gap,
                               const PathOptions &o)
    : contact(std::move(s))
    , options(o)
    , shared(std::make_shared<const PathSystem>(*contact, options.cohesion))
    , system(*shared)
    , ratio_test(shared, options.law)
    , now{Scheme(static_cast<std::size_t>(system.n_nodes())),
          VectorXd::Zero(system.size()),
          VectorXd::Zero(system.size()),
          VectorXd::Zero(system.size()),
          {},
          VectorXd::Zero(system.size())}
  {
    eigen_assert(gap.size() == system.n_nodes());
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
    eigen_assert(s.load.size() == system.size());
    eigen_assert(s.rate.size() == system.size());
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
          now.v(system.tangent[i]) = now.origin(system.tangent[i]);
    // Those of a mechanism are those of the scheme before it.
    if (rates.outcome == RateOutcome::found)
      factor.values(now.load, now.v, now.r);
  }



  void
  EventFollower::move_to(const double p, const VectorXd &v_rate)
  {
    eigen_assert(std::isfinite(p));
    eigen_assert(v_rate.size() == now.v.size());
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
  EventFollower::move_at_constant_load(const Rates &rates)
  {
    // The parameter stands still: the step is one of the motion. Gaps close,
    // slips end, and where it is no rigid one reactions fall.
    const PathEvents stops =
      RatioTest::first(ratio_test.events(now, rates.v, rates.r, motion_noise),
                       0);
    if (stops.empty())
      return false;
    const double step = stops.front().step;
    if (step * solvers::largest(rates.v) >
        value_tolerance * solvers::largest(now.v))
      {
        arrival = {now.scheme, rates.v, 0};
        now.v += step * rates.v;
        now.r += step * rates.r;
        plateau      = true;
        now.critical = ratio_test.critical_nodes(now);
      }
    ratio_test.add(stops, now);
    return true;
  }



  PathResult
  EventFollower::end(const PathOutcome outcome, const std::string &reason) const
  {
    PathResult result;
    result.outcome   = outcome;
    result.parameter = parameter;
    result.reason    = reason;
    return result;
  }



  EventFollower::End
  EventFollower::without_rates(const PathVisitor &visit)
  {
    if (options.law == PathLaw::holonomic)
      {
        if (arrival)
          return end(PathOutcome::not_converged,
                     "the path turns at this load, and no piece was found on "
                     "which it goes on");
        // Whatever there is needs loads that fall.
        return unloading().scheme.empty() ?
                 end(PathOutcome::not_converged,
                     "the path has no continuation at this load, neither with "
                     "growing nor with falling loads") :
                 end(PathOutcome::turning_point);
      }
    if (parameter > last.parameter || plateau || jumped)
      emit(visit, true);
    std::string reason;
    // Jumps that only lead to further ones do not lead on.
    if (++n_jumps > most_jumps)
      reason = "each equilibrium that a jump leads to breaks off at once";
    else if (jump(reason))
      return {};
    return end(PathOutcome::no_equilibrium, reason);
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
    point.turn      = turned;
    point.way       = way;
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
    if (point.changes.empty() && !always && !plateau && !jumped && !turned)
      return;
    plateau = jumped = turned = false;
    if (visit)
      visit(point);
    last = std::move(point);
  }



  /** The piece on which loads would fall, as one that comes from there; without
   * a scheme: there is none. */
  Arrival
  EventFollower::unloading() const
  {
    const Rates back =
      solve_rate_problem(system, now.scheme, now.critical, -load_rate);
    if (back.outcome == RateOutcome::none)
      return {};
    return {back.scheme, -back.v, 1};
  }



  Rates
  EventFollower::next_rates() const
  {
    Rates rates =
      solve_rate_problem(system, now.scheme, now.critical, way * load_rate);
    rates.way = way;
    if (rates.outcome != RateOutcome::none)
      return rates;
    Arrival from = arrival ? *arrival : unloading();
    if (from.scheme.empty())
      return rates;
    ratio_test.turn_closing_nodes(now, from.scheme);
    Rates around = pass_vertex(system, from, now.critical, load_rate);
    // Without a piece that the path came on, its start, p cannot fall, nor
    // under Coulomb's law.
    if (around.way < 0 && (!arrival || options.law == PathLaw::incremental))
      around.outcome = RateOutcome::none;
    return around;
  }



  /* Such a piece would be followed for ever. */
  bool
  EventFollower::was_here()
  {
    if (!has_turned)
      return false;
    const double size = solvers::largest(now.v);
    for (const Piece &piece : pieces)
      if (piece.way == way && piece.scheme == now.scheme &&
          solvers::largest(piece.v - now.v) <= same_state * size)
        return true;
    pieces.push_back({now.scheme, way, now.v});
    return false;
  }



  EventFollower::End
  EventFollower::go(const PathEvents  &first,
                    const VectorXd    &velocity,
                    const PathVisitor &visit)
  {
    const double limit = way > 0 ? upper : lower;
    if (first.empty() && !std::isfinite(limit))
      return end(PathOutcome::not_converged, "the load falls without end");
    // Without any event ahead the states hold for all larger loads. That is no
    // limit load.
    if (first.empty() ||
        first.front().step >
          way * (limit - parameter) + beyond_end * (stage.end - stage.begin))
      {
        move_to(limit, way * velocity);
        emit(visit, true);
        return end(way < 0       ? PathOutcome::returned_to_start :
                   first.empty() ? PathOutcome::no_further_change :
                                   PathOutcome::target_reached);
      }
    if (was_here())
      return end(PathOutcome::cycle);
    const double next = parameter + way * first.front().step;
    move_to(way > 0 ? std::min(next, limit) : std::max(next, limit),
            way * velocity);
    if (options.law == PathLaw::holonomic)
      arrival = {now.scheme, velocity, way};
    now.critical = ratio_test.critical_nodes(now);
    ratio_test.add(first, now);
    return {};
  }



  EventFollower::End
  EventFollower::advance(const PathVisitor &visit)
  {
    ratio_test.turn_closing_nodes(now, now.scheme);
    Rates rates = next_rates();
    if (rates.outcome == RateOutcome::none)
      return without_rates(visit);
    take(rates);
    if (rates.outcome == RateOutcome::mechanism)
      {
        emit(visit, false);
        if (move_at_constant_load(rates))
          return {};
        PathResult result = end(PathOutcome::limit_load);
        result.mechanism  = system.scale.cwiseProduct(rates.v);
        result.mechanism /= solvers::largest(result.mechanism);
        return result;
      }

    const double so_far = std::abs(parameter - stage.begin),
                 length = stage.end - stage.begin;
    const PathEvents first =
      RatioTest::first(ratio_test.events(now, rates.v, rates.r, rate_noise),
                       so_far);
    // What follows at once belongs to the same event.
    if (RatioTest::are_now(first, so_far) && ratio_test.add(first, now))
      return {};
    if (rates.way < way && !jumping && parameter >= upper - beyond_end * length)
      {
        // The target itself: what loads beyond it do is another stage's.
        emit(visit, true);
        return end(PathOutcome::target_reached);
      }
    turned     = rates.way != way;
    has_turned = has_turned || turned;
    way        = rates.way;
    emit(visit, false);
    n_jumps = 0;
    return go(first, rates.v, visit);
  }



  PathResult
  EventFollower::walk(const PathVisitor &visit)
  {
    // Degenerate events could repeat at one load.
    const std::size_t most_events = 1000 + 100 * now.scheme.size();
    for (std::size_t k = 0; k < most_events; ++k)
      if (const End ended = advance(visit))
        return *ended;
    return end(PathOutcome::not_converged,
               "the states of contact change without end at this load");
  }



  PathResult
  EventFollower::follow(const PathStage &s, const PathVisitor &visit)
  {
    check_start(s);
    stage     = s;
    parameter = last.parameter = lower = stage.begin;
    upper                              = stage.end;
    load_rate                          = system.scale.cwiseProduct(stage.rate);
    now.critical                       = ratio_test.critical_nodes(now);
    way                                = 1;
    n_jumps                            = 0;
    has_turned                         = false;
    arrival.reset();
    pieces.clear();
    return walk(visit);
  }



  std::unique_ptr<PathFollower>
  make_event_follower(std::shared_ptr<const solvers::ContactSystem> system,
                      const Eigen::VectorXd                        &gap,
                      const PathOptions                            &options)
  {
    return std::make_unique<EventFollower>(std::move(system), gap, options);
  }
} // namespace conetact::load_path
