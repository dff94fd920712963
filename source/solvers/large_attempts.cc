// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What LargeNewton begins an increment with, one start after the other, and
// what it remembers of the last one.

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

    /** What stalls there has the states of a solution. */
    constexpr double near_enough = 1e-3;

    /** Changes of load that differ by less go on as before. */
    constexpr double same_way = .1;

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
    eigen_assert(start.u.size() == body->n_unknowns());
    eigen_assert(end.u.size() == body->n_unknowns());
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
        auto system = std::make_shared<ContactSystem>(*cones);
        system->mu *= factor;
        easier.system = system;
        attach(factor > 1 ? easier : problem);
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
