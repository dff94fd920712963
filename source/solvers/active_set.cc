// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/active_set.h"

#include "conetact/solvers/unloaded.h"
#include "conetact/solvers/without_fall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Array = Eigen::VectorXd;

    const char *const name = "active set";

    /** A load that differs by less from the one in balance is the same. */
    constexpr double rounding = 1e-15;

    /** Where slip does not go on as before, most of what slipped may stick. */
    void
    stick(ContactState &state)
    {
      std::replace(state.node.begin(),
                   state.node.end(),
                   NodeState::slip,
                   NodeState::stick);
    }

    /** Gaps of nodes that meet something [length]. */
    std::vector<double>
    gaps_of(const ContactProblem &problem)
    {
      std::vector<double> gaps;
      for (Eigen::Index i = 0; i < problem.gap.size(); ++i)
        if (!problem.is_apart(i))
          gaps.push_back(problem.gap[i]);
      return gaps;
    }

    /**
     * States of starts that have none, one after the other: what touches
     * sticks, or what is no further away than many times the median gap; the
     * rest is open. None where gaps are alike: then all stick anyway.
     */
    std::vector<std::vector<NodeState>>
    near_ones_stick(const ContactProblem &problem)
    {
      constexpr double touching = 1e-6; // of the largest gap
      constexpr double far_away = 10;   // of the median gap

      std::vector<std::vector<NodeState>> starts;
      std::vector<double>                 gaps = gaps_of(problem);
      if (gaps.empty())
        return starts;
      std::sort(gaps.begin(), gaps.end());
      for (const double limit :
           {touching * gaps.back(), far_away * gaps[gaps.size() / 2]})
        if (gaps.front() <= limit && limit < gaps.back())
          {
            starts.emplace_back();
            for (const double gap : problem.gap)
              starts.back().push_back(gap > limit ? NodeState::open :
                                                    NodeState::stick);
          }
      return starts;
    }
  } // namespace



  ActiveSet::ActiveSet(const SolverOptions &solver_options)
    : options(solver_options)
  {}



  void
  ActiveSet::attach(const ContactProblem &problem)
  {
    if (!system || !system->relation().is(problem.system))
      {
        // Factors and the last change of load belong to the matrix that they
        // came from.
        system.emplace(problem.system);
        predictor = Predictor();
      }
    system->set_load(problem);
  }



  SolverReport
  ActiveSet::run(const ContactProblem &problem,
                 const Array          &p,
                 NodeSets              sets,
                 ContactState         &state,
                 const SolverOptions  &by)
  {
    NewtonPoint point = system->point_at(p);
    point.sets        = std::move(sets);
    // The residual of the first point says nothing: its states are not those
    // of its z.
    point.law = std::numeric_limits<double>::infinity();
    // Well below the tolerance: verification compares with the forces of one
    // body, which may be far smaller than the norm of all.
    const double goal = std::max(1e-4 * options.tolerance, 1e-14);
    SolverReport report =
      SemismoothNewton(*system, by)
        .run(problem, point, state, {goal, options.tolerance});
    if (report.converged)
      report.solver = name;
    return report;
  }



  SolverReport
  ActiveSet::solve_from_states(const ContactProblem &problem,
                               ContactState         &state)
  {
    Array p, d;
    system->relation().to_scaled(state, p, d);
    return run(
      problem, p, sets_of_state(system->relation(), state), state, options);
  }



  SolverReport
  ActiveSet::solve_with_own_slopes(const ContactProblem &problem,
                                   ContactState         &state)
  {
    system->take_own_slopes(true);
    const SolverReport report = solve_from_states(problem, state);
    system->take_own_slopes(false);
    return report;
  }



  /* Near the end Newton's own slopes are the better ones, as they converge
     quadratically: a few times in turn, one set of slopes leads nearer, the
     other one tries to end it. Only solutions of the problem itself count. */
  SolverReport
  ActiveSet::solve_without_fall(const ContactProblem &problem,
                                ContactState         &state)
  {
    constexpr unsigned int most    = 5;
    const ContactProblem   without = without_fall(problem);
    attach(without);
    SolverReport sum = solve_from_states(without, state);
    for (unsigned int i = 0; i < most && state.v.allFinite(); ++i)
      {
        ContactState end    = state;
        SolverReport report = polish(problem, end);
        add_work(report, sum);
        sum = report;
        if (sum.converged)
          {
            state = end;
            return sum;
          }
        report = polish(without, state);
        add_work(report, sum);
        sum           = report;
        sum.converged = false;
      }
    return sum;
  }



  /* Friction that sees a small part of slips grows gently. That part grows from
     solution to solution, in steps that go by whether the last one led to one:
     what is slow moves on between the stations, and none of its states jump. */
  SolverReport
  ActiveSet::solve_by_slower_slip(const ContactProblem &problem,
                                  ContactState         &state)
  {
    constexpr unsigned int most = 300, few = 8;
    constexpr double       least = 1e-8, smallest_step = 1.02;
    double                 solved = 0, part = .1, ratio = 10;
    const ContactState     start = state;
    SolverReport           sum;
    for (unsigned int i = 0; i < most && part >= least && ratio > smallest_step;
         ++i)
      {
        const ContactProblem easier =
          part < 1 ? with_slower_slip(problem, part) : problem;
        ContactState next = solved > 0 ? state : start;
        SolverReport report;
        if (solved > 0)
          {
            system->take_own_slopes(true);
            report = polish(easier, next, few);
            system->take_own_slopes(false);
          }
        if (!report.converged)
          {
            next                      = solved > 0 ? state : start;
            const SolverReport before = report;
            report =
              solved > 0 ? polish(easier, next, few) : solve_from(easier, next);
            add_work(report, before);
          }
        add_work(report, sum);
        sum = report;
        if (report.converged)
          {
            state  = next;
            solved = part;
            ratio  = std::min(100., std::pow(ratio, 1.5));
          }
        else if (solved > 0)
          ratio = std::sqrt(ratio);
        if (solved == 1)
          return sum;
        part = solved > 0 ? std::min(1., solved * ratio) : .1 * part;
      }
    sum.converged = false;
    return sum;
  }



  SolverReport
  ActiveSet::unchanged(const ContactProblem &problem, ContactState &state) const
  {
    SolverReport report;
    state.node       = classify(problem, state, 0);
    report.residual  = contact_residual(problem, state);
    report.converged = report.residual <= options.tolerance;
    report.solver    = name;
    return report;
  }



  void
  ActiveSet::solve_otherwise(const ContactProblem &problem,
                             const ContactState   &start,
                             ContactState         &state,
                             SolverReport         &report)
  {
    const auto try_from = [&](ContactState other, const auto &method) {
      const SolverReport before = report;
      report                    = (this->*method)(problem, other);
      add_work(report, before);
      if (report.converged)
        state = other;
    };
    if (start.node.empty())
      for (auto &states : near_ones_stick(problem))
        if (!report.converged)
          {
            ContactState near = start;
            near.node         = std::move(states);
            try_from(near, &ActiveSet::solve_from_states);
          }
    if (report.converged || problem.has_cones())
      return;
    try_from(start, &ActiveSet::solve_with_own_slopes);
    if (!report.converged)
      try_from(start, &ActiveSet::solve_without_fall);
    if (!report.converged && grows_from_rest(problem))
      try_from(start, &ActiveSet::solve_by_slower_slip);
  }



  /* In order: the state as it is, if the load is that of the start; bodies that
     nothing presses; where the load leads if it goes on as before; the states
     of the start, or near nodes stuck if it has none; slopes that lead on where
     friction falls. The work of all of them is counted. */
  SolverReport
  ActiveSet::solve(const ContactProblem &problem, ContactState &state)
  {
    attach(problem);
    ContactState start = state;
    start.u            = Array(); // v is where the increment starts
    Array p, d;
    system->relation().to_scaled(start, p, d);
    // Up to its sign, how far the load has moved from the one that the start is
    // in balance with.
    Array change = d - system->dual(p);
    if (change.norm() <= rounding * std::max({p.norm(), d.norm(), 1.}))
      if (const SolverReport report = unchanged(problem, start);
          report.converged)
        {
          state.node = start.node;
          return report;
        }

    if (auto end = stay_without_load(problem, start))
      {
        state      = std::move(*end);
        state.node = classify(problem, state, 0);
        SolverReport report;
        report.solver    = name;
        report.converged = true;
        return report;
      }

    // Each increment has its own scale of loads; changes of two increments are
    // compared in units.
    ContactState with_units;
    system->relation().from_scaled(p, change, with_units);
    change = system->relation().stiffness() ? with_units.r : with_units.v;
    SolverReport report;
    if (std::optional<ContactState> guess = predictor.predict(start, change))
      {
        report = polish(problem, *guess);
        state  = *guess;
      }
    if (!report.converged)
      {
        const unsigned int iterations     = report.iterations;
        const unsigned int factorizations = report.factorizations;
        state                             = start;
        // A guess that failed, or a load that turns: slips of the increment
        // before tell nothing.
        if (iterations > 0 || predictor.turns(start, change))
          stick(state);
        report = solve_from_states(problem, state);
        report.iterations += iterations;
        report.factorizations += factorizations;
      }
    if (!report.converged)
      solve_otherwise(problem, start, state, report);
    if (report.converged)
      predictor.remember(start, state, change);
    return report;
  }



  SolverReport
  ActiveSet::polish(const ContactProblem &problem,
                    ContactState         &state,
                    const unsigned int    most)
  {
    attach(problem);
    Array p, d;
    system->relation().to_scaled(state, p, d);
    SolverOptions few  = options;
    few.max_iterations = std::min(few.max_iterations, most);
    return run(problem, p, sets_of_point(system->relation(), p, d), state, few);
  }



  std::unique_ptr<ContactSolver>
  make_active_set(const SolverOptions &options)
  {
    return std::make_unique<ActiveSet>(options);
  }
} // namespace conetact::solvers
