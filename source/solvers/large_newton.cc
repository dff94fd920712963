// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/large_newton.h"

#include <algorithm>
#include <cmath>
#include <map>
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
                     best_precision = 1e-4;

    /** Of the tolerance: what the iteration aims at for directions. */
    constexpr double askew_aim = .6;

    /** Steps without much gain before a step is cut, before giving up. */
    constexpr unsigned int max_stalls = 8;

    /** Of the least residual so far: what is more is no gain. */
    constexpr double progress = .98;

    /** As long as residuals fall by this factor, directions of friction that
     * are not exact enough get better, too. */
    constexpr double slow_gain = .8;

    /** Residuals below this that do not improve any more are rounding. */
    constexpr double balance_noise = 1e-11;

    /**
     * The part of the slip law that turns is at most this over one that does
     * not: a node that hardly slips would rule the residual of linear systems
     * else. Newton's matrix alone has it, the solution has not.
     */
    constexpr double largest_ratio = .9;

    double
    largest_norm(const VectorXd &a, const VectorXd &b, const double c)
    {
      return std::max({a.norm(), b.norm(), c});
    }

    /** The least residuals so far, relative and as forces, and the steps since
     * one of them has gained much. */
    struct Gains
    {
      double       least, least_force;
      unsigned int stalls = 0;

      void
      see(const double residual, const double forces)
      {
        const bool gains = residual < progress * least ||
                           residual * forces < progress * least_force;
        stalls      = gains ? 0 : stalls + 1;
        least       = std::min(least, residual);
        least_force = std::min(least_force, residual * forces);
      }
    };

    /** Of the next linear system: no better than Newton's method gains, or than
     * what is still to be gained. */
    double
    precision_after(const double gain, const double to_goal)
    {
      return std::clamp(std::max(.9 * std::pow(gain, 1.5), to_goal),
                        best_precision,
                        least_precision);
    }

    /** The problem as its contact unknowns see it. */
    ContactProblem
    of_contact(const ContactProblem &problem)
    {
      ContactProblem result = problem;
      result.load = problem.load.tail(problem.system->n_unknowns()).eval();
      return result;
    }

  } // namespace



  LargeNewton::LargeNewton(const SolverOptions &solver_options)
    : options(solver_options)
  {}



  void
  LargeNewton::attach(const ContactProblem &problem)
  {
    eigen_assert(problem.system->large);
    eigen_assert(problem.load.size() == problem.system->large->n_unknowns());
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
    eigen_assert(relation && body);
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
    eigen_assert(static_cast<Index>(sets.size()) ==
                 relation->system().n_nodes());
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
    eigen_assert(manner.precision > 0);
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
    Gains                gains{point.residual(), point.residual() * forces};
    double               gain     = 0; // of the last step
    bool                 improved = true;
    std::optional<Point> settled; // as exact as rounding lets it be
    const auto           is_askew = [&] {
      return gain < slow_gain && askew_friction(*relation,
                                                point.sets,
                                                point.p,
                                                point.d,
                                                options.tolerance) > askew;
    };
    const auto goes_on = [&] {
      return point.residual() > goal ||
             (improved && point.residual() * point.scale > goal) || is_askew();
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
        forces   = relation->force_scale(point.p, point.d);
        gain     = residual / before * std::min(forces / forces_before, 1.);
        improved = gain < .5;
        if (residual <= balance_noise &&
            (!settled || residual < settled->residual()))
          settled = point;
        if (settled && !improved && !is_askew())
          {
            point = std::move(*settled);
            break;
          }
        // States may change node by node: little gain is progress, too.
        gains.see(residual, forces);
        const std::string next      = signature(point.sets);
        const auto        last_time = seen.find(next);
        const bool        cycles    = next != current && !improved &&
                            last_time != seen.end() &&
                            residual > .5 * last_time->second;
        current = next;
        if (cycles && !manner.damped)
          return "cycling between state sets";
        if (gains.stalls > max_stalls)
          {
            if (manner.damped)
              return stalled(residual);
            manner = {true, exact};
          }
        if (!manner.damped)
          manner.precision = precision_after(gain, .3 * goal / residual);
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
} // namespace conetact::solvers
