// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/large_newton.h"

#include "conetact/solvers/load_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    // Of linear systems: the first one decides about the states of all nodes,
    // those after it gain as much as Newton's method does.
    constexpr double first_precision = 1e-3, least_precision = 3e-2,
                     best_precision = 1e-4, exact = 1e-9;

    /** Of the tolerance: what the iteration aims at, and for directions. */
    constexpr double aim = 1e-2, askew_aim = .6;

    /** Steps without much gain before a step is cut, before giving up. */
    constexpr unsigned int max_stalls = 8;

    /** Of the least residual so far: what is more is no gain. */
    constexpr double progress = .98;

    /** What stalls there has the states of a solution. */
    constexpr double near_enough = 1e-3;

    /** Residuals below this that do not improve any more are rounding. */
    constexpr double balance_noise = 1e-11;

    /**
     * The part of the slip law that turns is at most this over one that does
     * not: a node that hardly slips would rule the residual of linear systems
     * else. Newton's matrix alone has it, the solution has not.
     */
    constexpr double largest_ratio = .9;

    /** Changes of load that differ by less go on as before. */
    constexpr double same_way = .1;

    double
    largest_norm(const VectorXd &a, const VectorXd &b, const double c)
    {
      return std::max({a.norm(), b.norm(), c});
    }

    /** The problem as its contact unknowns see it. */
    ContactProblem
    of_contact(const ContactProblem &problem)
    {
      ContactProblem result = problem;
      result.load = problem.load.tail(problem.system->n_unknowns()).eval();
      return result;
    }

    ContactState
    of_contact(ContactState state, const Index n)
    {
      state.u = state.u.tail(n).eval();
      return state;
    }

    /** What has moved contacts without strain since the start. */
    VectorXd
    change_of_offset(const ContactProblem &problem, const ContactState &start)
    {
      return problem.offset -
             (start.v - start.u.tail(problem.system->n_unknowns()));
    }
  } // namespace



  LargeNewton::LargeNewton(const SolverOptions &solver_options)
    : options(solver_options)
  {}



  void
  LargeNewton::attach(const ContactProblem &problem)
  {
    if (!relation || !relation->is(problem.system))
      {
        relation.emplace(problem.system);
        last.reset();
      }
    relation->set_load(of_contact(problem));
    body            = problem.system->large;
    load            = body->keep(problem.load);
    load_of_contact = problem.load.tail(problem.system->n_unknowns());
  }



  double
  LargeNewton::product(const Kept &x, const Kept &y) const
  {
    return body->product_elsewhere(x, y) +
           body->of_contact(x).dot(body->of_contact(y));
  }

  double
  LargeNewton::norm(const Kept &x) const
  {
    return std::sqrt(product(x, x));
  }



  LargeNewton::Point
  LargeNewton::point_at(Kept u, Kept f) const
  {
    Point       point;
    const Array r = body->of_contact(f);
    relation->to_scaled({{}, r, {}, body->of_contact(u)}, point.p, point.d);
    point.law    = law_residual(*relation, point.p, point.d);
    double scale = largest_norm(r, load_of_contact, force);
    if (scale == 0) // nothing touches, and nothing ever has
      scale = norm(load);
    const double left = std::sqrt(body->product_elsewhere(f, f));
    point.balance     = left > 0 ? left / scale : 0.;
    point.u           = std::move(u);
    point.f           = std::move(f);
    if (const double there = largest_norm(r, load_of_contact, 0); there > 0)
      point.scale = std::max(scale / there, 1.);
    return point;
  }



  LargeNewton::Point
  LargeNewton::point_at(Kept u) const
  {
    Kept f = body->add(body->multiply(u), -1, load);
    return point_at(std::move(u), std::move(f));
  }



  /* Laws in the units of forces and displacements. */
  std::vector<NodeLaw>
  LargeNewton::laws(const Point &point, NodeSets sets) const
  {
    for (NodeSet &set : sets)
      set.ratio = std::min(set.ratio, largest_ratio);
    std::vector<NodeLaw> result =
      linearized_laws(*relation, sets, point.p, point.d, true);
    for (Index i = 0; i < relation->system().n_nodes(); ++i)
      {
        const double scale =
          relation->column_scale()(relation->system().first[i]);
        NodeLaw &law = result[static_cast<std::size_t>(i)];
        law.p /= scale * scale;
        law.h *= relation->unit() / scale;
      }
    return result;
  }



  /* Where all nodes that hold a body slip the strongest one sticks, or all of
     them, until they are seen to slip with something left that holds, as in
     ActiveSet. */
  std::vector<NodeSets>
  LargeNewton::holding_sets(const Point &point) const
  {
    const ContactSystem &system = relation->system();
    if (resist_motions(system, point.sets))
      return {point.sets};
    std::vector<NodeSets> result;
    for (const NodeSets &sets :
         {with_strongest_stuck(*relation, point.sets, point.d),
          without_slip(*relation, point.sets)})
      if (resist_motions(system, sets))
        result.push_back(sets);
    return result.empty() ? std::vector<NodeSets>{point.sets} : result;
  }



  std::optional<LargeNewton::Point>
  LargeNewton::step_with(const NodeSets &sets,
                         const Point    &point,
                         const Manner   &manner,
                         SolverReport   &report) const
  {
    const double forces =
      std::max(relation->force_scale(point.p, point.d), force);
    const auto found =
      body->solve(laws(point, sets), point.f, {manner.precision, forces});
    if (!found)
      return {};
    report.krylov += found->iterations;
    ++report.iterations;
    Point trial = point_at(body->add(point.u, 1, found->du));
    if (manner.damped)
      {
        const Kept Kdu = body->add(trial.f, -1, point.f);
        for (double tau = .5;
             tau > .02 && !(trial.residual() < point.residual());
             tau /= 2)
          trial = point_at(body->add(point.u, tau, found->du),
                           body->add(point.f, tau, Kdu));
        trial = point_at(trial.u); // sums of steps round
      }
    if (!std::isfinite(trial.residual()))
      return {};
    trial.sets = sets_of_point(*relation, trial.p, trial.d);
    return trial;
  }



  /** False if there is no step. */
  bool
  LargeNewton::step(Point &point, const Manner &manner, SolverReport &report)
  {
    std::optional<Point> taken;
    for (const NodeSets &sets : holding_sets(point))
      {
        if (auto trial = step_with(sets, point, manner, report))
          taken = std::move(trial);
        // one that slips again at once does not hold either
        if (taken && signature(taken->sets) != signature(point.sets))
          break;
      }
    if (taken)
      point = std::move(*taken);
    return taken.has_value();
  }



  std::string
  LargeNewton::iterate(Point        &point,
                       SolverReport &report,
                       const bool    exactly,
                       const double  goal)
  {
    const double askew = std::max(goal, askew_aim * options.tolerance);
    std::map<std::string, double> seen; // with residuals
    std::string                   current = signature(point.sets);
    Manner                        manner{exactly,
                  exactly           ? exact :
                                         point.d.isZero(0) ? best_precision :
                                                             first_precision};
    double               forces = relation->force_scale(point.p, point.d);
    double               least = point.residual(), least_force = least * forces;
    unsigned int         stalls   = 0;
    bool                 improved = true;
    std::optional<Point> settled; // as exact as rounding lets it be
    const auto           goes_on = [&] {
      return point.residual() > goal ||
             (improved && point.residual() * point.scale > goal) ||
             (improved && askew_friction(*relation,
                                         point.sets,
                                         point.p,
                                         point.d,
                                         options.tolerance) > askew);
    };
    while (goes_on())
      {
        if (report.iterations >= options.max_iterations)
          return stalled(point.residual());
        seen.insert_or_assign(current, point.residual());
        const double before = point.residual(), forces_before = forces;
        if (!step(point, manner, report))
          return "singular tangent";
        const double residual = point.residual();
        // Residuals are relative: reactions that vanish make them large.
        forces = relation->force_scale(point.p, point.d);
        const double gain =
          residual / before * std::min(forces / forces_before, 1.);
        improved = gain < .5;
        if (residual <= balance_noise &&
            (!settled || residual < settled->residual()))
          settled = point;
        if (settled && !improved)
          {
            point = std::move(*settled);
            break;
          }
        // States may change node by node: little gain is progress, too.
        stalls                      = residual < progress * least ||
                     residual * forces < progress * least_force ?
                                        0 :
                                        stalls + 1;
        least                       = std::min(least, residual);
        least_force                 = std::min(least_force, residual * forces);
        const std::string next      = signature(point.sets);
        const auto        last_time = seen.find(next);
        const bool        cycles    = next != current && !improved &&
                            last_time != seen.end() &&
                            residual > .5 * last_time->second;
        current = next;
        if (cycles && !manner.damped)
          return "cycling between state sets";
        if (stalls > max_stalls)
          {
            if (manner.damped)
              return stalled(residual);
            manner = {true, exact};
          }
        if (!manner.damped)
          manner.precision =
            std::clamp(std::max(.9 * std::pow(gain, 1.5), .3 * goal / residual),
                       best_precision,
                       least_precision);
      }
    return "";
  }



  SolverReport
  LargeNewton::run(const ContactProblem &problem,
                   Point                 point,
                   ContactState         &state,
                   const bool            exactly)
  {
    SolverReport report;
    const Index  n = relation->system().n_unknowns();
    report.reason  = iterate(point, report, exactly, aim * options.tolerance);
    if (!report.reason.empty() &&
        (!nearest || point.residual() < nearest->residual()))
      nearest = point;
    set_exact_zeros(*relation, point.sets, point.p, point.d);
    relation->from_scaled(point.p, point.d, state);
    // Exact zeros of v = u + o are those of u without offset; of a large one
    // they are rounded, and would take u out of its balance.
    const bool has_offset = state.u.size() == n;
    state.u               = body->numbers(point.u);
    if (!has_offset)
      state.u.tail(n) = state.v;
    state.node      = classify(problem, state, 0);
    report.residual = contact_residual(problem, state);
    report.converged =
      report.residual <= options.tolerance &&
      point.balance <= std::max(options.tolerance, balance_noise);
    if (report.converged)
      {
        report.reason.clear();
        report.solver = "iterative";
      }
    else if (report.reason.empty())
      report.reason = stalled(report.residual);
    return report;
  }



  std::optional<LargeNewton::Point>
  LargeNewton::predict(const ContactProblem &problem,
                       const ContactState   &state,
                       const Kept           &u) const
  {
    if (!last)
      return {};
    // one increment once more, with a load that is a little better
    if (is_at(state, u, last->start_u, last->start_r))
      return point_at(
        body->add(u, 1, body->add(last->end_u, -1, last->start_u)));
    if (!is_at(state, u, last->end_u, last->end_r))
      return {};
    // obstacles and supports that move are loads, too
    const double c         = relation->system().diagonal().mean();
    const Kept   of_load   = body->add(load, -1, last->end_load);
    const Array  of_offset = c * change_of_offset(problem, state);
    const double along =
      product(of_load, last->load) + c * of_offset.dot(last->offset);
    const double size =
      product(last->load, last->load) + c * c * last->offset.squaredNorm();
    if (!(size > 0))
      return {};
    const double s    = along / size;
    const double rest = std::hypot(norm(body->add(of_load, -s, last->load)),
                                   (of_offset - s * c * last->offset).norm());
    if (rest > same_way * std::hypot(norm(of_load), of_offset.norm()))
      return {};
    return point_at(body->add(u, s, last->u));
  }



  bool
  LargeNewton::is_at(const ContactState &state,
                     const Kept         &of_state,
                     const Kept         &u,
                     const Array        &r) const
  {
    return (state.r == r && !r.isZero(0)) ||
           norm(body->add(of_state, -1, u)) == 0;
  }



  void
  LargeNewton::remember(const ContactProblem &problem,
                        const ContactState   &start,
                        const ContactState   &end)
  {
    const Kept start_u = body->keep(start.u);
    const bool follows =
      last && is_at(start, start_u, last->end_u, last->end_r);
    if (!follows && !start.u.isZero(0))
      {
        last.reset(); // the load that it started from is not known
        return;
      }
    Last next;
    next.start_u  = start_u;
    next.start_r  = start.r;
    next.end_load = load;
    next.end_u    = body->keep(end.u);
    next.end_r    = end.r;
    next.u        = body->add(next.end_u, -1, start_u);
    next.load     = follows ? body->add(load, -1, last->end_load) : load;
    next.offset   = change_of_offset(problem, start);
    last          = std::move(next);
  }



  bool
  LargeNewton::leaves(const SolverReport &report) const
  {
    return options.leaves && options.leaves(report.krylov);
  }



  SolverReport
  LargeNewton::solve_whole(const ContactProblem &problem, ContactState &state)
  {
    attach(problem);
    const Array           nearby = std::exchange(state.nearby, Array());
    const Kept            u      = body->keep(state.u);
    const Index           n      = relation->system().n_unknowns();
    const ContactState    start  = of_contact(std::move(state), n);
    SolverReport          report, sum;
    std::set<std::string> known;
    const auto            took = [&](const SolverReport &attempt) {
      const std::string before = report.reason;
      report                   = attempt;
      if (!report.converged && report.reason.empty()) // nothing was tried
        report.reason = before;
      add_work(sum, report);
      report.iterations = sum.iterations;
      report.krylov     = sum.krylov;
      return report.converged;
    };
    const auto tried = [&](Point point, const bool exactly) {
      state = start;
      return took(run(problem, std::move(point), state, exactly));
    };
    const auto tried_exactly = [&](const NodeSets &sets) {
      Point point = point_at(u);
      point.sets  = sets;
      return known.insert(signature(sets)).second &&
             tried(std::move(point), true);
    };
    auto guess = nearby.size() > 0 ? point_at(body->keep(nearby)) :
                                     predict(problem, start, u);
    if (guess)
      {
        guess->sets = sets_of_point(*relation, guess->p, guess->d);
        if (tried(std::move(*guess), false))
          return report;
      }
    Point point      = point_at(u);
    point.sets       = sets_of_point(*relation, point.p, point.d);
    const bool stays = point.residual() <= aim * options.tolerance;
    if (!stays)
      point.sets = sets_of_state(*relation, start);
    const NodeSets before = point.sets;
    if (tried(std::move(point), false) || leaves(report))
      return report;
    state = start;
    if (took(solve_with_falling_friction(problem, u, state)) || leaves(report))
      return report;
    ContactState cold = all_stuck(start);
    if (tried_exactly(before) || tried_exactly(sets_of_state(*relation, cold)))
      return report;
    // only those whose gaps are closed, or are driven to close
    cold.node = driven_states(start, u);
    tried_exactly(sets_of_state(*relation, cold));
    return report;
  }



  /* To begin with. */
  ContactState
  LargeNewton::all_stuck(const ContactState &start) const
  {
    ContactState state = start;
    state.node.clear();
    return state;
  }



  /* Of bodies that float: with all contacts stuck their reactions balance the
     load, which moves them the other way. */
  std::vector<NodeState>
  LargeNewton::driven_states(const ContactState &start, const Kept &u)
  {
    const ContactSystem &system  = relation->system();
    Point                point   = point_at(u);
    Array                opening = relation->displacements(point.p, point.d);
    ContactState         stuck   = all_stuck(start);
    stuck.node.assign(static_cast<std::size_t>(system.n_nodes()),
                      NodeState::stick);
    SolverReport report;
    point.sets = sets_of_state(*relation, stuck);
    if (system.null_space.cols() > 0 && step(point, {false, exact}, report))
      {
        const Array r = body->of_contact(point.f);
        opening =
          -system.null_space * (system.null_space.transpose() * r).eval();
        opening.array() += 1e-6 * solvers::largest(opening);
      }
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (opening[system.normal(i)] > 0)
        stuck.node[static_cast<std::size_t>(i)] = NodeState::open;
    return stuck.node;
  }



  SolverReport
  LargeNewton::solve_with_falling_friction(const ContactProblem &problem,
                                           const Kept           &start_u,
                                           ContactState         &state)
  {
    // of what is on the way states matter only
    constexpr double   least_ratio = 1.1, enough = 1e-6;
    const ContactState start = state;
    ContactProblem     easier(problem);
    Kept               u = start_u; // of the last factor that is solved
    SolverReport       report, sum;
    double             solved = 0;
    if (problem.system->n_nodes() == 0 || problem.system->mu.maxCoeff() == 0)
      return report;
    const double much = std::max(1 / problem.system->mu.maxCoeff(), 2.);
    for (double factor = much, ratio = 2;;)
      {
        auto system = std::make_shared<ContactSystem>(*problem.system);
        system->mu *= factor;
        easier.system = factor > 1 ? system : problem.system;
        attach(easier);
        Point point = point_at(u);
        point.sets  = solved > 0 ? sets_of_point(*relation, point.p, point.d) :
                                   sets_of_state(*relation, all_stuck(start));
        state       = start;
        if (factor > 1)
          {
            report        = {};
            report.reason = iterate(point, report, true, enough);
          }
        else
          report = run(problem, point, state, true);
        add_work(sum, report);
        if (leaves(sum))
          break;
        if (report.reason.empty())
          {
            solved = factor;
            u      = point.u;
          }
        else
          ratio = solved > 0 ? std::sqrt(solved / factor) : 1;
        if (solved == 1 || ratio < least_ratio)
          break;
        factor = std::max(solved / ratio, 1.);
      }
    attach(problem);
    report.iterations = sum.iterations;
    report.krylov     = sum.krylov;
    return report;
  }



  SolverReport
  LargeNewton::solve_in_parts(const ContactProblem &problem,
                              ContactState         &state)
  {
    // What the start of the increment and its end differ in.
    Array of_load =
      problem.load - body->numbers(body->multiply(body->keep(state.u)));
    of_load.tail(problem.system->n_unknowns()) += state.r;
    const Array of_offset = change_of_offset(problem, state);

    LoadParts parts;
    parts.smallest = 1. / std::min(options.max_substeps, 64u);
    parts.load =
      [&](const double done, const Array &slipped, ContactProblem &part) {
        part.load   = problem.load - (1 - done) * of_load;
        part.offset = problem.offset - (1 - done) * of_offset - slipped;
      };
    parts.solve = [&](const ContactProblem &part, ContactState &trial) {
      return solve_whole(part, trial);
    };
    const SolverReport report = solvers::solve_in_parts(parts, problem, state);
    last.reset();
    return report;
  }



  SolverReport
  LargeNewton::solve(const ContactProblem &problem, ContactState &state)
  {
    const ContactState start = state;
    force                    = problem.reference_force;
    nearest.reset();
    SolverReport report = solve_whole(problem, state);
    if (report.converged)
      {
        remember(problem, start, state);
        return report;
      }
    state = start;
    if (options.max_substeps < 2)
      {
        if (nearest && nearest->residual() <= near_enough)
          {
            state.nearby = body->numbers(nearest->u);
            state.node.clear();
            for (const NodeSet &set : nearest->sets)
              state.node.push_back(set.state);
          }
        return report;
      }
    SolverReport parts = solve_in_parts(problem, state);
    add_work(parts, report);
    return parts;
  }
} // namespace conetact::solvers
