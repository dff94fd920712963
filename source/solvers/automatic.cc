// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/automatic.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    void
    count(SolverReport &total, const SolverReport &part)
    {
      total.iterations += part.iterations;
      total.factorizations += part.factorizations;
    }

    /** v = (0, gap): where an increment starts. */
    VectorXd
    start_of(const ContactSystem &system, const VectorXd &gap)
    {
      VectorXd result = VectorXd::Zero(system.n_unknowns());
      for (Index i = 0; i < system.n_nodes(); ++i)
        result(system.normal(i)) = gap(i);
      return result;
    }

    /** v with the normal components set to zero: the slips. */
    VectorXd
    slips_of(const ContactSystem &system, VectorXd v)
    {
      for (Index i = 0; i < system.n_nodes(); ++i)
        v(system.normal(i)) = 0;
      return v;
    }

    /** The load that holds (v, r) in balance. */
    VectorXd
    load_of(const ContactSystem &system, const VectorXd &v, const VectorXd &r)
    {
      if (system.form == Form::stiffness)
        return system.matrix * v - r;
      return v - system.matrix * r;
    }
  } // namespace



  Automatic::Automatic(const SolverOptions &solver_options)
    : options(solver_options)
    , active_set(solver_options)
  {}



  SolverReport
  Automatic::globalize(const ContactProblem &problem, ContactState &state)
  {
    if (!relation || !relation->is(problem.system))
      relation.emplace(problem.system);
    relation->set_load(problem);

    SmoothingOptions smoothing = options.smoothing;
    smoothing.scaled           = true;
    SmoothingIteration iteration(*relation, smoothing, state);
    SolverReport       report;
    ContactState       trial = state;
    for (double target = 1e-2; target >= .5 * options.tolerance; target *= 1e-2)
      {
        const bool reached = iteration.advance(target);
        iteration.get(trial);
        if (trial.v.allFinite() && trial.r.allFinite())
          {
            const SolverReport polish = active_set.polish(problem, trial);
            count(report, polish);
            if (polish.converged)
              {
                report.converged = true;
                report.residual  = polish.residual;
                report.solver    = "smoothing";
                state            = trial;
                break;
              }
          }
        if (!reached)
          break;
      }
    report.iterations += iteration.n_iterations();
    report.factorizations += iteration.n_factorizations();
    if (!report.converged)
      report.reason =
        iteration.failure().empty() ? "residual stalled" : iteration.failure();
    return report;
  }



  SolverReport
  Automatic::solve_whole(const ContactProblem &problem, ContactState &state)
  {
    ContactState      trial        = state;
    SolverReport      report       = active_set.solve(problem, trial);
    const std::string first_reason = report.reason;
    if (!report.converged)
      {
        trial                     = state;
        const SolverReport second = globalize(problem, trial);
        count(report, second);
        report.converged = second.converged;
        report.residual  = second.residual;
        report.solver    = second.solver;
        report.reason    = second.converged ? "" : second.reason;
      }
    if (report.converged)
      state = trial;
    return report;
  }



  SolverReport
  Automatic::solve_in_parts(const ContactProblem &problem, ContactState &state)
  {
    const ContactSystem &system = *problem.system;
    const VectorXd b0 = load_of(system, start_of(system, problem.gap), state.r);
    const VectorXd change = problem.load - b0;

    SolverReport   report;
    ContactState   now  = state;
    VectorXd       slip = VectorXd::Zero(system.n_unknowns());
    ContactProblem part = problem;
    double         done = 0, size = .5, residual = 0;
    const double   smallest = 1. / options.max_substeps;
    report.substeps         = 0;
    while (done < 1)
      {
        const double next  = std::min(1., done + size);
        ContactState trial = now;
        trial.v            = start_of(system, part.gap);
        // What has slipped so far is part of the load of the next part.
        part.load = b0 + next * change;
        if (system.form == Form::stiffness)
          part.load -= system.matrix * slip;
        else
          part.load -= slip;
        const SolverReport one = solve_whole(part, trial);
        count(report, one);
        if (!one.converged)
          {
            report.reason = one.reason;
            size /= 2;
            if (size < smallest)
              break;
            continue;
          }
        residual      = std::max(residual, one.residual);
        report.solver = one.solver;
        ++report.substeps;
        slip += slips_of(system, trial.v);
        for (Index i = 0; i < system.n_nodes(); ++i)
          part.gap(i) = trial.v(system.normal(i));
        now  = trial;
        done = next;
        size = std::min(2 * size, 1 - done);
      }
    report.residual  = residual;
    report.converged = done >= 1;
    if (report.converged)
      {
        report.reason.clear();
        state   = now;
        state.v = slip + start_of(system, part.gap);
        return report;
      }
    std::ostringstream text;
    text.precision(4);
    text << report.reason << "; solved up to " << done
         << " of the load of this increment";
    report.reason = text.str();
    return report;
  }



  SolverReport
  Automatic::solve(const ContactProblem &problem, ContactState &state)
  {
    // Here is the place to ask whether an equilibrium can exist at all.

    SolverReport report = solve_whole(problem, state);
    if (report.converged || problem.system->n_unknowns() == 0)
      return report;
    if (options.max_substeps < 2)
      return report;
    SolverReport parts = solve_in_parts(problem, state);
    count(parts, report);
    return parts;
  }



  std::unique_ptr<ContactSolver>
  make_automatic(const SolverOptions &options)
  {
    return std::make_unique<Automatic>(options);
  }
} // namespace conetact
