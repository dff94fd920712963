// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/large_newton.h"

#include "conetact/solvers/load_parts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** An iteration that stalls below this residual has the states of a
     * solution, which serve as a start for another method. */
    constexpr double near_enough = 1e-3;

    /** Changes of load that differ by less than this part go on as before. */
    constexpr double same_way = .1;

    /** The part of the tolerance that the iteration aims at: the residual is a
     * norm of all nodes, where verification looks at single bodies. */
    constexpr double aim = 1e-2;

    ContactState
    of_contact(ContactState state, const Index n)
    {
      state.u = state.u.tail(n).eval();
      return state;
    }

    /** What has moved contacts without strain since the start: o at the end
     * less o = v - u at the start. */
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
    eigen_assert(problem.system->large);
    if (!elastic || !elastic->relation().is(problem.system))
      {
        elastic.emplace(problem.system, options.tolerance);
        last.reset();
      }
    elastic->set_load(problem);
  }



  SolverReport
  LargeNewton::run(const ContactProblem &problem,
                   NewtonPoint           point,
                   ContactState         &state,
                   const bool            exactly)
  {
    SolverReport report =
      SemismoothNewton(*elastic, options)
        .run(problem,
             point,
             state,
             {aim * options.tolerance, options.tolerance, exactly});
    const double balanced = std::max(options.tolerance, LargeOperator::noise);
    if (report.converged && !(point.balance <= balanced))
      {
        report.converged = false;
        report.reason    = stalled(point.residual());
      }
    if (report.converged)
      report.solver = "iterative";
    else if (!nearest || point.residual() < nearest->residual())
      nearest = std::move(point);
    return report;
  }



  /* u + s du of the last increment, where the load changes by
     db = s db_last + rest, s = (db . db_last) / |db_last|^2, with a rest of a
     tenth at most. Offsets are compared with loads by the mean stiffness c. */
  std::optional<NewtonPoint>
  LargeNewton::predict(const ContactProblem &problem,
                       const ContactState   &state,
                       const Kept           &u) const
  {
    if (!last)
      return {};
    // The increment is solved once more, with a load that is a little better.
    if (is_at(state, u, last->start_u, last->start_r))
      return elastic->point_at(elastic->body().add(
        u, 1, elastic->body().add(last->end_u, -1, last->start_u)));
    if (!is_at(state, u, last->end_u, last->end_r))
      return {};
    // Obstacles and supports that move are loads, too.
    const double c = elastic->relation().system().diagonal().mean();
    const Kept   of_load =
      elastic->body().add(elastic->load(), -1, last->end_load);
    const Array  of_offset = c * change_of_offset(problem, state);
    const double along =
      elastic->product(of_load, last->load) + c * of_offset.dot(last->offset);
    const double size = elastic->product(last->load, last->load) +
                        c * c * last->offset.squaredNorm();
    if (!(size > 0))
      return {};
    const double s = along / size;
    const double rest =
      std::hypot(elastic->norm(elastic->body().add(of_load, -s, last->load)),
                 (of_offset - s * c * last->offset).norm());
    if (rest > same_way * std::hypot(elastic->norm(of_load), of_offset.norm()))
      return {};
    return elastic->point_at(elastic->body().add(u, s, last->u));
  }



  bool
  LargeNewton::is_at(const ContactState &state,
                     const Kept         &of_state,
                     const Kept         &u,
                     const Array        &r) const
  {
    return (state.r == r && !r.isZero(0)) ||
           elastic->norm(elastic->body().add(of_state, -1, u)) == 0;
  }



  /* The change of load is known where an increment follows the last one, or
     begins without displacements, and so without load. */
  void
  LargeNewton::remember(const ContactProblem &problem,
                        const ContactState   &start,
                        const ContactState   &end)
  {
    eigen_assert(start.u.size() == elastic->body().n_own());
    eigen_assert(end.u.size() == elastic->body().n_own());
    const Kept start_u = elastic->body().keep(start.u);
    const bool follows =
      last && is_at(start, start_u, last->end_u, last->end_r);
    if (!follows && elastic->norm(start_u) > 0)
      {
        last.reset(); // the load that it started from is not known
        return;
      }
    Last next;
    next.start_u  = start_u;
    next.start_r  = start.r;
    next.end_load = elastic->load();
    next.end_u    = elastic->body().keep(end.u);
    next.end_r    = end.r;
    next.u        = elastic->body().add(next.end_u, -1, start_u);
    next.load     = follows ?
                      elastic->body().add(elastic->load(), -1, last->end_load) :
                      elastic->load();
    next.offset   = change_of_offset(problem, start);
    last          = std::move(next);
  }



  bool
  LargeNewton::leaves(const SolverReport &report) const
  {
    return options.leaves && options.leaves(report.krylov);
  }



  /**
   * Starts one after the other, each with a reason of its own. First where the
   * load leads, or is known to lead, for that is near the solution; then the
   * start of the increment with its states; then friction that falls to what it
   * is, since nodes that stick hold bodies that hang on friction alone; at last
   * cut steps, whose systems are solved to the end, from three sets: the states
   * of the start, all nodes stuck, those nodes stuck that the load closes. Of
   * these none is tried twice.
   */
  SolverReport
  LargeNewton::solve_whole(const ContactProblem &problem, ContactState &state)
  {
    attach(problem);
    const Array           nearby = std::exchange(state.nearby, Array());
    const Kept            u      = elastic->body().keep(state.u);
    const Index           n      = elastic->relation().system().n_unknowns();
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
    const auto tried = [&](NewtonPoint point, const bool exactly) {
      state = start;
      return took(run(problem, std::move(point), state, exactly));
    };
    const auto tried_exactly = [&](const NodeSets &sets) {
      NewtonPoint point = elastic->point_at(u);
      point.sets        = sets;
      return known.insert(signature(sets)).second &&
             tried(std::move(point), true);
    };
    auto guess = nearby.size() > 0 ?
                   elastic->point_at(elastic->body().keep(nearby)) :
                   predict(problem, start, u);
    if (guess)
      {
        guess->sets = sets_of_point(elastic->relation(), guess->p, guess->d);
        if (tried(std::move(*guess), false))
          return report;
      }
    NewtonPoint point = elastic->point_at(u);
    point.sets        = sets_of_point(elastic->relation(), point.p, point.d);
    const bool stays  = point.residual() <= aim * options.tolerance;
    if (!stays)
      point.sets = sets_of_state(elastic->relation(), start);
    const NodeSets before = point.sets;
    if (tried(std::move(point), false) || leaves(report))
      return report;
    state = start;
    if (took(solve_with_falling_friction(problem, u, state)) || leaves(report))
      return report;
    ContactState cold = all_stuck(start);
    if (tried_exactly(before) ||
        tried_exactly(sets_of_state(elastic->relation(), cold)))
      return report;
    // Only those stick whose gaps are closed, or are driven to close.
    cold.node = driven_states(start, u);
    tried_exactly(sets_of_state(elastic->relation(), cold));
    return report;
  }



  /* Without states all nodes stick to begin with. */
  ContactState
  LargeNewton::all_stuck(const ContactState &start) const
  {
    ContactState state = start;
    state.node.clear();
    return state;
  }



  /* Nodes are open where they have a gap at the start. Where bodies float, the
     load tells instead: with all contacts stuck, reactions r balance it, and
     without them bodies would go along -N N^T r, N their motions. Nodes that
     this opens are open, and those that it hardly moves (1e-6). */
  std::vector<NodeState>
  LargeNewton::driven_states(const ContactState &start, const Kept &u)
  {
    const ContactSystem &system = elastic->relation().system();
    NewtonPoint          point  = elastic->point_at(u);
    Array        opening = elastic->relation().displacements(point.p, point.d);
    ContactState stuck   = all_stuck(start);
    stuck.node.assign(static_cast<std::size_t>(system.n_nodes()),
                      NodeState::stick);
    SolverReport report;
    point.sets = sets_of_state(elastic->relation(), stuck);
    std::optional<NewtonPoint> end;
    if (system.null_space.cols() > 0)
      end = elastic->step(point.sets, point, LargeOperator::exact, report);
    if (system.null_space.cols() > 0 && !end)
      end =
        elastic->forced_step(point.sets, point, LargeOperator::exact, report);
    if (end)
      {
        const Array r = elastic->body().of_contact(end->f);
        opening =
          -system.null_space * (system.null_space.transpose() * r).eval();
        opening.array() += 1e-6 * solvers::largest(opening);
      }
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (opening[system.normal(i)] > 0)
        stuck.node[static_cast<std::size_t>(i)] = NodeState::open;
    return stuck.node;
  }



  /* A homotopy in the coefficients: all of them times a factor, which begins
     where the largest coefficient is one or twice itself and falls to 1 by a
     ratio of 2 at first. Each solution is where the next one starts. Where a
     factor fails the ratio becomes its square root, seen from the last one that
     was solved, until it is less than 1.1. */
  SolverReport
  LargeNewton::solve_with_falling_friction(const ContactProblem &problem,
                                           const Kept           &start_u,
                                           ContactState         &state)
  {
    // On the way states matter only, and residuals are small enough for that.
    constexpr double   least_ratio = 1.1, enough = 1e-6;
    const ContactState start  = state;
    ContactProblem     easier = with_coefficients_of(start, problem);
    const auto         cones  = easier.system;
    Kept               u      = start_u; // of the last factor that is solved
    SolverReport       report, sum;
    double             solved = 0;
    if (cones->n_nodes() == 0 || cones->mu.maxCoeff() == 0)
      return report;
    const double much = std::max(1 / cones->mu.maxCoeff(), 2.);
    for (double factor = much, ratio = 2;;)
      {
        auto rougher = std::make_shared<ContactSystem>(*cones);
        rougher->mu *= factor;
        easier.system = rougher;
        attach(factor > 1 ? easier : problem);
        NewtonPoint point = elastic->point_at(u);
        point.sets        = solved > 0 ?
                              sets_of_point(elastic->relation(), point.p, point.d) :
                              sets_of_state(elastic->relation(), all_stuck(start));
        state             = start;
        if (factor > 1)
          {
            report        = {};
            report.reason = SemismoothNewton(*elastic, options)
                              .iterate(point, report, {enough, enough, true});
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
    // The start is in balance with the load K u - r.
    Array of_load =
      problem.load - elastic->body().numbers(
                       elastic->body().multiply(elastic->body().keep(state.u)));
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
        // Another backend may go on from there.
        if (nearest && nearest->residual() <= near_enough)
          {
            state.nearby = elastic->body().numbers(nearest->u);
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
