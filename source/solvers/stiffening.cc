// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Bodies that are far apart, made stiffer step by step.

#include "conetact/solvers/automatic.h"

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** The same system with bodies that many times softer, less friction. */
    std::shared_ptr<const ContactSystem>
    softened(const ContactSystem &system,
             const double         times,
             const double         friction)
    {
      // Only W grows: motions and foundations keep their balance.
      auto        result = std::make_shared<ContactSystem>(system);
      const Index n      = system.n_contact_unknowns();
      result->matrix.topLeftCorner(n, n) *= times;
      result->mu *= friction;
      return result;
    }

    /**
     * With motions counted from a place near the end, where they have more
     * digits than from far away.
     */
    SolverReport
    solve_about(const VectorXd       &motions,
                const ContactProblem &problem,
                ContactState         &state,
                ContactSolver        &solver)
    {
      const Index    k    = motions.size();
      ContactProblem near = problem;
      // v = W r + G (a0 + da) + q: G a0 joins q, and C a0 joins -b.
      near.load += problem.system->matrix.rightCols(k) * motions;
      state.r.tail(k) -= motions;
      const SolverReport report = solver.solve(near, state);
      state.r.tail(k) += motions;
      return report;
    }
  } // namespace



  /**
   * Bodies that gaps keep apart by far more than they deform rest on a few
   * nodes, and Newton's method jumps from one to the other. Much softer ones
   * rest on many: they are made stiffer step by step, from one solution to the
   * next, until they are what they are. With friction such a path may turn
   * back: then with less of it, which the last step makes up for.
   */
  bool
  Automatic::stiffen(const ContactProblem &problem,
                     ContactState         &state,
                     SolverReport         &report)
  {
    const ContactSystem &system = *problem.system;
    const Index          n      = system.n_contact_unknowns();
    const double         force  = problem.load.tail(system.n_motions).norm();
    // How much larger the distances are than what the load compresses.
    const double softer = largest(problem.load.head(n)) /
                          (force * system.matrix.diagonal().head(n).mean());
    if (system.n_motions == 0 || !(softer > 10) || !std::isfinite(softer))
      return false;
    for (const double friction : {1., .3, .1, 0.})
      {
        ContactState now = state;
        if (!stiffen_from(softer, friction, problem, now, report))
          continue;
        const SolverReport last =
          solve_about(now.r.tail(system.n_motions), problem, now, active_set);
        add_work(report, last);
        report.solver   = "active set";
        report.residual = last.residual;
        if (last.converged)
          {
            state = now;
            return true;
          }
      }
    return false;
  }



  bool
  Automatic::stiffen_from(double                softer,
                          const double          friction,
                          const ContactProblem &problem,
                          ContactState         &state,
                          SolverReport         &report) const
  {
    constexpr unsigned int most_steps = 200;
    constexpr double       least_step = 1.001;
    constexpr unsigned int enough     = 40; // a shorter step takes fewer

    SolverOptions loose   = options;
    loose.tolerance       = std::max(1e-6, options.tolerance);
    loose.max_iterations  = std::min(loose.max_iterations, enough);
    ContactProblem part   = with_coefficients_of(state, problem);
    const auto     system = part.system;
    const auto     start  = state.v;
    double         solved = 0, ratio = 10;
    const double   softest = 1e6 * softer;
    state.node.clear();
    for (unsigned int step = 0;
         step < most_steps && report.iterations < most_solves &&
         !(options.stop && options.stop());
         ++step)
      {
        part.system             = softened(*system, softer, friction);
        ContactState       next = state;
        const SolverReport one  = ActiveSet(loose).solve(part, next);
        add_work(report, one);
        if (one.converged)
          {
            state = next;
            // The law counts slip from the start of the increment: stations on
            // the way are no increments.
            state.v = start;
            solved  = softer;
            ratio   = std::min(10., std::pow(ratio, 1.5));
          }
        else if (solved > 0)
          ratio = std::sqrt(ratio);
        if (solved == 1)
          return true;
        // As long as there is no first solution, softer still.
        softer = solved > 0 ? std::max(1., solved / ratio) : 10 * softer;
        if (ratio < least_step || softer > softest)
          return false;
      }
    return false;
  }
} // namespace conetact::solvers
