// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/event_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Quantities below this share of the largest have vanished. */
    constexpr double value_tolerance = 1e-12;
    /** Events closer than this share of the way from the start are one. */
    constexpr double same_event = 1e-10;
    /** Rates below this share of the largest are round-off. */
    constexpr double rate_noise = 1e-14, motion_noise = 1e-9;
    /** Events further off, in times of what a path took so far, never come. */
    constexpr double horizon = 1e7;
    /** An event this close behind the end of a stage, in its length, counts. */
    constexpr double beyond_end = 1e-12;
    /** Steps beyond a point without continuation, in the length of the stage.
     */
    constexpr double jump_steps[] = {1e-8, 1e-6, 1e-4};
  } // namespace



  EventFollower::EventFollower(std::shared_ptr<const ContactSystem> s,
                               const VectorXd                      &gap,
                               const PathOptions                   &o)
    : contact(std::move(s))
    , options(o)
    , system(*contact, options.cohesion)
    , scheme(static_cast<std::size_t>(system.n_nodes()))
    , v(VectorXd::Zero(system.size()))
    , r(VectorXd::Zero(system.size()))
    , load(VectorXd::Zero(system.size()))
  {
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index n = system.normal[static_cast<std::size_t>(i)];
        v(n)          = gap(i) / system.scale(n);
      }
    load       = system.K * v;
    last.v     = system.scale.cwiseProduct(v);
    last.r     = r;
    last.state = path_states();
  }



  void
  EventFollower::check_start(const PathStage &s) const
  {
    const VectorXd start = system.scale.cwiseProduct(s.load);
    if (largest(start - load) > 1e-9 * std::max(largest(start), largest(load)))
      throw std::invalid_argument(
        "A stage of a load path must start with the loads that the stage "
        "before it ended with, the first one with none but K (0, gap).");
    if (!(s.end > s.begin))
      throw std::invalid_argument("A stage of a load path must have a length.");
  }



  /** All nodes that stand at a corner of their law. */
  CriticalNodes
  EventFollower::critical_nodes() const
  {
    const double v_zero = value_tolerance * largest(v);
    const double r_zero = value_tolerance * std::max(largest(r), largest(load));
    const bool   holonomic = options.law == PathLaw::holonomic;
    CriticalNodes result(scheme.size());
    for (std::size_t i = 0; i < scheme.size(); ++i)
      {
        const auto       index = static_cast<Index>(i);
        const NodeScheme s     = scheme[i];
        const Index      n = system.normal[i], t = system.tangent[i];
        CriticalNode    &c = result[i];
        c.normal           = s.closed ? r(n) <= r_zero : v(n) <= v_zero;
        if (t < 0 || system.mu(index) + system.cohesion(index) == 0)
          continue;
        if (system.cohesion(index) == 0 && (c.normal || !s.closed))
          {
            // at the apex, where a total slip has a direction of its own
            const bool turned = holonomic && std::abs(v(t)) > v_zero;
            c.plus = c.minus = c.normal && !turned;
            continue;
          }
        const double bound = system.mu(index) * r(n) + system.cohesion(index);
        if (s.slip != 0)
          {
            const bool stops = !holonomic || s.slip * v(t) <= v_zero;
            c.plus           = s.slip > 0 && stops;
            c.minus          = s.slip < 0 && stops;
          }
        else
          {
            c.plus  = bound + r(t) <= r_zero;
            c.minus = bound - r(t) <= r_zero;
          }
      }
    return result;
  }



  void
  EventFollower::mark(const Event &event, CriticalNodes &nodes) const
  {
    const auto    i = static_cast<std::size_t>(event.node);
    CriticalNode &c = nodes[i];
    const Index   t = system.tangent[i];
    if (event.hit == Hit::plus)
      c.plus = true;
    else if (event.hit == Hit::minus)
      c.minus = true;
    else
      {
        c.normal = true;
        if (t < 0 || system.cohesion(event.node) > 0 ||
            system.mu(event.node) == 0)
          return;
        const bool turned = options.law == PathLaw::holonomic &&
                            std::abs(v(t)) > value_tolerance * largest(v);
        c.plus = c.minus = !turned;
      }
  }



  /** What vanishes along a straight path, and when. */
  std::vector<EventFollower::Event>
  EventFollower::events(const VectorXd &v_rate,
                        const VectorXd &r_rate,
                        const double    noise) const
  {
    const double v_size = largest(v), v_fast = largest(v_rate);
    const double r_size = largest(r), r_fast = largest(r_rate);
    const bool   holonomic = options.law == PathLaw::holonomic;

    std::vector<Event> result;
    // Critical quantities have been decided: what falls there is round-off.
    const auto consider = [&](const Index  i,
                              const Hit    hit,
                              const double value,
                              const double rate,
                              const double size,
                              const double fast) {
      const CriticalNode &c       = critical[static_cast<std::size_t>(i)];
      const bool          decided = hit == Hit::normal ? c.normal :
                                    hit == Hit::plus   ? c.plus :
                                                         c.minus;
      if (!decided && rate < -noise * fast &&
          value * fast <= -rate * horizon * std::max(size, value))
        result.push_back(
          {std::max(0., value) / -rate, 1e-13 * size / -rate, i, hit});
    };
    for (std::size_t k = 0; k < scheme.size(); ++k)
      {
        const auto       i = static_cast<Index>(k);
        const NodeScheme s = scheme[k];
        const Index      n = system.normal[k], t = system.tangent[k];
        if (s.closed)
          consider(i, Hit::normal, r(n), r_rate(n), r_size, r_fast);
        else
          consider(i, Hit::normal, v(n), v_rate(n), v_size, v_fast);
        if (t < 0 || system.is_free(i, s.closed))
          continue;
        const double mu = system.mu(i), bound = mu * r(n) + system.cohesion(i);
        for (const int side : {1, -1})
          {
            const Hit hit = side > 0 ? Hit::plus : Hit::minus;
            if (s.slip == 0)
              consider(i,
                       hit,
                       bound + side * r(t),
                       mu * r_rate(n) + side * r_rate(t),
                       r_size,
                       r_fast);
            else if (holonomic && s.slip == side)
              consider(i, hit, side * v(t), side * v_rate(t), v_size, v_fast);
          }
      }
    return result;
  }



  std::vector<EventFollower::Event>
  EventFollower::first_events(const std::vector<Event> &all,
                              const double              from) const
  {
    const auto earlier = [](const Event &a, const Event &b) {
      return a.step < b.step;
    };
    std::vector<Event> result;
    if (all.empty())
      return result;
    const double step = std::min_element(all.begin(), all.end(), earlier)->step;
    for (const Event &e : all)
      if (e.step <= step + e.blur + same_event * (from + step))
        result.push_back(e);
    std::sort(result.begin(), result.end(), earlier);
    return result;
  }



  bool
  EventFollower::add(const std::vector<Event> &first)
  {
    bool added = false;
    for (const Event &e : first)
      {
        const auto         i      = static_cast<std::size_t>(e.node);
        const CriticalNode before = critical[i];
        mark(e, critical);
        added = added || before.normal != critical[i].normal ||
                before.plus != critical[i].plus ||
                before.minus != critical[i].minus;
      }
    return added;
  }



  /**
   * A node that closes under the holonomic law slips the way it has moved: its
   * guess for the rate problem.
   */
  void
  EventFollower::turn_closing_nodes()
  {
    if (options.law == PathLaw::incremental)
      return;
    for (std::size_t i = 0; i < scheme.size(); ++i)
      if (const Index t = system.tangent[i];
          t >= 0 && critical[i].normal && !scheme[i].closed &&
          system.is_free(static_cast<Index>(i), false))
        scheme[i].slip = critical[i].plus ? 0 : v(t) > 0 ? 1 : -1;
  }



  /** Takes the decision of a rate problem. */
  void
  EventFollower::take(Rates &rates)
  {
    scheme = rates.scheme;
    factor = std::move(rates.factor);
    if (options.law == PathLaw::holonomic)
      for (std::size_t i = 0; i < scheme.size(); ++i)
        if (system.tangent[i] >= 0 && scheme[i].slip == 0 &&
            !system.is_free(static_cast<Index>(i), scheme[i].closed))
          v(system.tangent[i]) = 0;
    // Those of a mechanism are those of the scheme before it.
    if (rates.outcome == RateOutcome::found)
      factor.values(load, v, r);
  }



  void
  EventFollower::move_to(const double p, const VectorXd &v_rate)
  {
    v += (p - parameter) * v_rate;
    parameter = p;
    load =
      system.scale.cwiseProduct(stage.load + (p - stage.begin) * stage.rate);
    factor.values(load, v, r);
  }



  /** Follows a mechanism until it stops; false: it never does. */
  bool
  EventFollower::move_at_constant_load(const VectorXd &velocity)
  {
    const std::vector<Event> stops =
      first_events(events(velocity, VectorXd::Zero(r.size()), motion_noise), 0);
    if (stops.empty())
      return false;
    const double step = stops.front().step;
    if (step * largest(velocity) > value_tolerance * largest(v))
      {
        v += step * velocity;
        plateau  = true;
        critical = critical_nodes();
      }
    add(stops);
    return true;
  }



  /**
   * Solves the whole problem from where the path stands, at a parameter just
   * beyond, and takes the states of the result.
   */
  bool
  EventFollower::solve_beyond(const double p, std::string &reason)
  {
    VectorXd       slipped = system.scale.cwiseProduct(v);
    ContactState   state;
    ContactProblem problem;
    state.v        = slipped;
    state.r        = r.cwiseQuotient(system.scale);
    problem.system = contact;
    problem.gap.resize(system.n_nodes());
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index n  = system.normal[static_cast<std::size_t>(i)];
        problem.gap(i) = std::max(0., slipped(n));
        slipped(n)     = 0;
      }
    state.v -= slipped;
    problem.load =
      stage.load + (p - stage.begin) * stage.rate - contact->matrix * slipped;
    SolverOptions solver_options;
    solver_options.tolerance = options.tolerance;
    const SolverReport report =
      make_solver(solver_options)->solve(problem, state);
    reason = report.reason;
    if (!report.converged)
      return false;
    for (std::size_t i = 0; i < scheme.size(); ++i)
      {
        const Index t    = system.tangent[i];
        scheme[i].closed = state.node[i] != NodeState::open;
        scheme[i].slip   = 0;
        if (t >= 0 && state.node[i] == NodeState::slip)
          scheme[i].slip = state.v(t) > 0 ? 1 : -1;
      }
    v      = (slipped + state.v).cwiseQuotient(system.scale);
    factor = SchemeFactor(system, scheme, false);
    if (!factor.regular())
      factor = SchemeFactor(system, scheme, true);
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
    const VectorXd v_before = v, r_before = r;
    const Scheme   scheme_before = scheme;
    std::string    reason;
    for (const double step : jump_steps)
      {
        const double beyond = from + step * (stage.end - stage.begin);
        if (solve_beyond(beyond, reason))
          {
            for (const double p : {from, beyond})
              {
                move_to(p, VectorXd::Zero(v.size()));
                if (here().residual <= options.tolerance)
                  {
                    jumped   = true;
                    critical = critical_nodes();
                    result.reason.clear();
                    return true;
                  }
              }
            reason = "an equilibrium was found in several steps only.";
          }
        v         = v_before;
        r         = r_before;
        scheme    = scheme_before;
        parameter = from;
      }
    result.reason = "The path has no continuation at this load, and a full "
                    "solve found no other equilibrium: " +
                    reason;
    return false;
  }



  PathResult
  EventFollower::end_without_rates(PathResult result)
  {
    const VectorXd backward = system.scale.cwiseProduct(-stage.rate);
    const Rates back = solve_rate_problem(system, scheme, critical, backward);
    if (back.outcome == RateOutcome::found)
      result.outcome = PathOutcome::turning_point;
    else
      result.reason = "The path has no continuation at this load, neither with "
                      "growing nor with falling loads.";
    return result;
  }



  std::vector<PathState>
  EventFollower::path_states() const
  {
    std::vector<PathState> result;
    for (std::size_t i = 0; i < scheme.size(); ++i)
      {
        const NodeScheme s    = scheme[i];
        const auto       node = static_cast<Index>(i);
        const bool       free = system.is_free(node, s.closed);
        if (!s.closed)
          result.push_back(s.slip == 0 || free ? PathState::open :
                           s.slip > 0          ? PathState::open_plus :
                                                 PathState::open_minus);
        else if (free && system.tangent[i] >= 0)
          result.push_back(PathState::slip);
        else
          result.push_back(s.slip == 0 ? PathState::stick :
                           s.slip > 0  ? PathState::slip_plus :
                                         PathState::slip_minus);
      }
    return result;
  }



  /** Where the path stands, as a point after the last one. */
  PathPoint
  EventFollower::here() const
  {
    PathPoint point;
    point.parameter = parameter;
    point.v         = system.scale.cwiseProduct(v);
    point.r         = r.cwiseQuotient(system.scale);
    point.plateau   = plateau;
    point.jump      = jumped;
    point.state     = path_states();
    for (std::size_t i = 0; i < point.state.size(); ++i)
      if (point.state[i] != last.state[i])
        point.changes.push_back(
          {static_cast<Index>(i), last.state[i], point.state[i]});
    point.residual = path_residual(
      *contact, options, load.cwiseQuotient(system.scale), last, point);
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
    critical                   = critical_nodes();

    PathResult        result;
    unsigned int      jumps       = 0;
    const std::size_t most_events = 1000 + 100 * scheme.size();
    for (std::size_t k = 0; k < most_events; ++k)
      {
        result.parameter = parameter;
        turn_closing_nodes();
        Rates rates = solve_rate_problem(system, scheme, critical, load_rate);
        if (rates.outcome == RateOutcome::none)
          {
            if (options.law == PathLaw::holonomic)
              return end_without_rates(result);
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
            result.mechanism /= largest(result.mechanism);
            return result;
          }

        const std::vector<Event> first =
          first_events(events(rates.v, rates.r, rate_noise),
                       parameter - stage.begin);
        const double step = first.empty() ? 0. : first.front().step;
        // What follows at once belongs to the same event.
        if (!first.empty() &&
            step <=
              first.front().blur + same_event * (parameter - stage.begin) &&
            add(first))
          continue;
        emit(visit, false);
        jumps = 0;
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
        critical = critical_nodes();
        add(first);
      }
    result.reason = "The states of contact change without end at this load.";
    return result;
  }



  std::unique_ptr<PathFollower>
  make_event_follower(std::shared_ptr<const ContactSystem> system,
                      const Eigen::VectorXd               &gap,
                      const PathOptions                   &options)
  {
    return std::make_unique<EventFollower>(std::move(system), gap, options);
  }
} // namespace conetact
