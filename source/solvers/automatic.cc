// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/automatic.h"

#include "conetact/solvers/doubtful_end.h"
#include "conetact/solvers/gauss_seidel.h"
#include "conetact/solvers/load_parts.h"
#include "conetact/solvers/redundant_contacts.h"
#include "conetact/solvers/smoothing_newton.h"
#include "conetact/solvers/unloaded.h"

#include <algorithm>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** The method without u of the part before, which does not go with the
     * offset of this one. What rounding holds is no end of a part. */
    LoadParts::Method
    anew(const LoadParts::Method &method)
    {
      return [method](const ContactProblem &part, ContactState &state) {
        state.u             = VectorXd();
        SolverReport report = method(part, state);
        if (report.converged && is_held_by_rounding(part, state))
          {
            report.converged = false;
            report.reason    = "bodies move without end";
          }
        return report;
      };
    }

    /** Whether so little presses that a jam may have been lost. */
    bool
    may_have_lost_jam(const ContactProblem &problem,
                      const ContactState   &start,
                      const ContactState   &end)
    {
      constexpr double little = .01;
      const Index      n      = problem.system->n_contact_unknowns();
      return problem.system->null_space.cols() > 0 &&
             lets_go(start.r.head(n), end.r.head(n), little);
    }

    bool
    is_stopped(const SolverOptions &options)
    {
      return options.stop && options.stop();
    }

    /** Whether reactions are rounding of those that close gaps would need. */
    bool
    presses_nothing(const ContactProblem &problem, const ContactState &state)
    {
      const ContactSystem &system = *problem.system;
      const Index          n      = system.n_contact_unknowns();
      if (system.form != Form::compliance || system.n_motions == 0)
        return false;
      return largest(state.r.head(n)) *
               system.matrix.diagonal().head(n).mean() <=
             1e-12 * largest(problem.load.head(n));
    }
  } // namespace



  Automatic::Automatic(const SolverOptions &solver_options)
    : options(solver_options)
    , active_set(solver_options)
  {}



  bool
  Automatic::polish(const ContactProblem &problem,
                    ContactState         &state,
                    SolverReport         &report,
                    const unsigned int    most)
  {
    if (!state.v.allFinite() || !state.r.allFinite())
      return false;
    const SolverReport exact = active_set.polish(problem, state, most);
    add_work(report, exact);
    report.converged = exact.converged;
    report.residual  = exact.residual;
    return exact.converged;
  }



  bool
  Automatic::smooth(const ContactProblem &problem,
                    ContactState         &state,
                    const double          m0,
                    SolverReport         &report)
  {
    // smoothed cones are cones: friction that varies is that of the start
    const ContactProblem cones = with_coefficients_of(state, problem);
    if (!relation || !relation->is(cones.system))
      relation.emplace(cones.system);
    relation->set_load(cones);

    SmoothingOptions smoothing = options.smoothing;
    smoothing.stop             = options.stop;
    smoothing.m0 = smoothing.eps0 = m0;
    SmoothingIteration iteration(*relation, smoothing, state);
    ContactState       trial  = state;
    bool               solved = false, going = true;
    // States are right long before the residual is small: every second digit is
    // worth an attempt to end exactly, which takes a few steps or fails.
    constexpr unsigned int few = 15;
    for (double target = 1e-2;
         going && !solved && target > .1 * options.tolerance;
         target *= 1e-2)
      {
        going = iteration.advance(target);
        iteration.get(trial);
        solved = polish(problem, trial, report, few);
      }
    report.iterations += iteration.n_iterations();
    report.factorizations += iteration.n_factorizations();
    report.solver = "smoothing";
    report.reason = iteration.failure();
    if (solved)
      state = trial;
    return solved;
  }



  bool
  Automatic::move_out(const ContactProblem &problem,
                      ContactState         &state,
                      SolverReport         &report)
  {
    auto end = move_without_load(problem, state);
    if (!end)
      return false;
    state           = std::move(*end);
    state.node      = classify(problem, state, 0);
    report.solver   = "active set";
    report.residual = 0;
    return true;
  }



  bool
  Automatic::relax(const ContactProblem &problem,
                   ContactState         &state,
                   const unsigned int    sweeps,
                   SolverReport         &report)
  {
    // motions have no reaction of their own that a sweep could find
    if (problem.system->n_motions > 0)
      return false;
    SolverOptions few                           = options;
    few.max_sweeps                              = sweeps;
    ContactState                         trial  = state;
    const std::unique_ptr<ContactSolver> solver = make_gauss_seidel(few);
    solver->solve(problem, trial);
    report.solver = "gauss-seidel";
    if (!polish(problem, trial, report))
      return false;
    state = trial;
    return true;
  }



  /**
   * With the motions eliminated: in a stiffness digits are lost, but where all
   * nodes of a body slip it still tells where the body goes. What is found is
   * made exact with the motions as unknowns.
   */
  bool
  Automatic::eliminate_motions(const ContactProblem &problem,
                               ContactState         &state,
                               const bool            thorough,
                               SolverReport         &report)
  {
    if (problem.system->n_motions == 0)
      return false;
    if (!eliminated || !eliminated->is_of(problem.system))
      eliminated.emplace(problem.system);
    if (!eliminated->exists())
      return false;
    ContactState own = eliminated->eliminate(state);
    Automatic    inner(options);
    inner.most_solves = most_solves - std::min(most_solves, report.iterations);
    const SolverReport found =
      inner.solve_whole(eliminated->eliminate(problem), own, thorough);
    add_work(report, found);
    ContactState trial = eliminated->expand(problem, own);
    report.solver      = found.solver;
    if (!polish(problem, trial, report))
      return false;
    state = trial;
    return true;
  }



  SolverReport
  Automatic::solve_whole(const ContactProblem &problem,
                         ContactState         &state,
                         const bool            thorough)
  {
    SolverReport report = solve_fast(problem, state);
    if (!report.converged)
      solve_slowly(problem, state, thorough, report);
    return report;
  }



  SolverReport
  Automatic::solve_fast(const ContactProblem &problem, ContactState &state)
  {
    ContactState trial  = state;
    SolverReport report = active_set.solve(problem, trial);
    if (report.converged)
      state = trial;
    return report;
  }



  void
  Automatic::solve_slowly(const ContactProblem &problem,
                          ContactState         &state,
                          const bool            thorough,
                          SolverReport         &report)
  {
    // A few nodes that cannot make up their mind are what node by node is good
    // at; the smoothing sees all nodes at once.
    const auto go_on = [&] {
      return !is_stopped(options) && report.iterations < most_solves;
    };
    bool solved =
      eliminate_motions(problem, state, thorough, report) ||
      (go_on() && move_out(problem, state, report)) ||
      (go_on() && stiffen(problem, state, report)) ||
      (go_on() && relax(problem, state, 30, report)) ||
      (go_on() && smooth(problem, state, options.smoothing.m0, report));
    if (!solved && thorough)
      solved =
        (go_on() && relax(problem, state, 300, report)) ||
        (go_on() && smooth(problem, state, 100 * options.smoothing.m0, report));
    report.converged = solved;
    if (solved)
      report.reason.clear();
    else if (report.reason.empty())
      report.reason = "residual stalled";
  }



  bool
  Automatic::solve_again(const ContactProblem &problem,
                         ContactState         &state,
                         SolverReport         &report)
  {
    SolverReport again = solve_whole(problem, state, true);
    add_work(again, report);
    report = std::move(again);
    return report.converged;
  }



  LoadParts
  Automatic::parts_of(const ContactProblem &problem,
                      const ContactState   &state) const
  {
    LoadParts parts   = parts_from(state, problem);
    parts.smallest    = 1. / options.max_substeps;
    parts.stop        = options.stop;
    parts.is_doubtful = [&problem](const ContactState &start,
                                   const ContactState &end) {
      return may_have_lost_jam(problem, start, end);
    };
    return parts;
  }



  SolverReport
  Automatic::solve_in_parts(const ContactProblem &problem, ContactState &state)
  {
    LoadParts parts = parts_of(problem, state);
    parts.solve = anew([&](const ContactProblem &part, ContactState &trial) {
      return solve_whole(part, trial, false);
    });
    return solvers::solve_in_parts(parts, problem, state);
  }



  SolverReport
  Automatic::solve_in_fast_parts(const ContactProblem &problem,
                                 ContactState         &state)
  {
    SolverOptions few  = options; // steps: more are found in smaller parts
    few.max_iterations = std::min(few.max_iterations, 30U);
    ActiveSet quick(few);
    LoadParts parts   = parts_of(problem, state);
    parts.is_too_much = options.is_limit;
    parts.solve = anew([&](const ContactProblem &part, ContactState &trial) {
      return quick.solve(part, trial);
    });
    parts.otherwise =
      anew([&](const ContactProblem &part, ContactState &trial) {
        return solve_whole(part, trial, false);
      });
    return solvers::solve_in_parts(parts, problem, state);
  }



  bool
  Automatic::ends_at_once(const ContactProblem &problem,
                          ContactState         &state,
                          FastParts            &fast,
                          SolverReport         &report)
  {
    if (options.ends_early && options.ends_early())
      return true;
    if (!options.is_limit || options.max_substeps < 2 ||
        problem.system->null_space.cols() == 0)
      return false;
    fast.last   = state;
    fast.report = solve_in_fast_parts(problem, fast.last);
    add_work(report, fast.report);
    if (fast.report.converged || !options.is_limit(fast.last, next_to_limit))
      return false;
    state         = fast.last;
    report.reason = fast.report.reason;
    return true;
  }



  /* Where parts lead to the end, that of the whole may be far: rollers on
     contacts of a node or two have some that thousands of solves find. */
  bool
  Automatic::solve_slowly_or_in_parts(const ContactProblem &problem,
                                      const FastParts      &fast,
                                      ContactState         &state,
                                      SolverReport         &report)
  {
    constexpr unsigned int enough = 200; // solves
    if (fast.report.converged)
      most_solves = report.iterations + enough;
    solve_slowly(problem, state, true, report);
    most_solves = any_number;
    if (report.converged || !fast.report.converged || is_stopped(options))
      return false;
    const SolverReport all = std::exchange(report, fast.report);
    report.iterations      = all.iterations;
    report.factorizations  = all.factorizations;
    state                  = fast.last;
    return true;
  }



  void
  Automatic::take_jam(const ContactProblem &problem,
                      const ContactState   &start,
                      const ContactState   &jammed,
                      SolverReport          parts,
                      ContactState         &state,
                      SolverReport         &report)
  {
    ContactState whole = jammed;
    whole.u            = VectorXd();
    const bool ends    = polish(problem, whole, report) &&
                      !may_have_lost_jam(problem, start, whole);
    report.converged = true;
    state            = ends ? whole : jammed;
    if (ends)
      return;
    add_work(parts, report);
    report = std::move(parts);
  }



  void
  Automatic::follow_doubtful(const ContactProblem &problem,
                             const ContactState   &start,
                             ContactState         &state,
                             SolverReport         &report)
  {
    const bool is_far = is_held_by_rounding(problem, state);
    if (options.max_substeps < 2 || is_stopped(options) ||
        (!is_far && !may_have_lost_jam(problem, start, state)))
      return;
    ContactState       last  = start;
    const SolverReport parts = solve_in_fast_parts(problem, last);
    if (parts.converged && !is_far && !may_have_lost_jam(problem, start, last))
      {
        take_jam(problem, start, last, parts, state, report);
        return;
      }
    add_work(report, parts);
    if (parts.converged || !is_far || !options.is_limit ||
        !options.is_limit(last, next_to_limit))
      return;
    state            = last;
    report.converged = false;
    report.reason    = parts.reason;
  }



  SolverReport
  Automatic::solve(const ContactProblem &problem, ContactState &state)
  {
    // Of redundant contacts the best that was found is a start for others, and
    // of use to the caller.
    ContactState estimate = state;
    SolverReport first;
    const bool   redundant = options.may_be_rigid && !problem.laws &&
                           is_sparse_compliance(*problem.system);
    if (redundant)
      first = make_redundant_contacts(options)->solve(problem, estimate);
    if (first.converged || is_stopped(options))
      {
        state = estimate;
        return first;
      }

    ContactState shortest = state, alone = state;
    FastParts    fast;
    SolverReport report = solve_fast(problem, state);
    add_work(report, first);
    if (!report.converged &&
        (ends_at_once(problem, state, fast, report) ||
         solve_slowly_or_in_parts(problem, fast, state, report)))
      return report;
    if (!report.converged && is_stopped(options))
      return report;
    if (redundant && !report.converged)
      if (ContactState trial = estimate; solve_again(problem, trial, report))
        state = trial;
    if (report.converged)
      {
        follow_doubtful(problem, alone, state, report);
        if (!report.converged)
          return report;
      }
    // Where nothing presses, any motion that opens all contacts is a solution;
    // the shortest is what is promised.
    if (report.converged && presses_nothing(problem, state) &&
        move_out(problem, shortest, report))
      state = shortest;
    if (report.converged || problem.system->n_unknowns() == 0)
      return report;
    if (options.max_substeps < 2)
      {
        state           = estimate;
        report.residual = contact_residual(problem, state);
        return report;
      }
    // Of what fast parts have not begun with, the slow ones try the same.
    SolverReport parts;
    if (fast.report.substeps > 0)
      parts = solve_in_parts(problem, state);
    else
      parts.reason = fast.report.reason;
    add_work(parts, report);
    if (parts.converged || is_stopped(options))
      return parts;
    // It needs no polish where states that share a force cannot settle.
    SolverReport smoothed =
      make_smoothing_newton(options)->solve(problem, alone);
    if (!smoothed.converged)
      return parts;
    add_work(smoothed, parts);
    state = alone;
    return smoothed;
  }



  std::unique_ptr<ContactSolver>
  make_automatic(const SolverOptions &options)
  {
    return std::make_unique<Automatic>(options);
  }
} // namespace conetact::solvers
