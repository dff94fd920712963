// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/load_parts.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** v with the normal components set to zero: the slips. */
    VectorXd
    slips_of(const ContactSystem &system, VectorXd v)
    {
      for (Index i = 0; i < system.n_nodes(); ++i)
        v(system.normal(i)) = 0;
      v.tail(system.n_motions).setZero();
      return v;
    }

    /** Load and offset at the end of an increment less those at its start. */
    struct Change
    {
      VectorXd of_load, of_offset;
      VectorXd offset_at_end;
    };

    /**
     * The start of the increment as the end of one without change: v = (0, gap)
     * with the reactions and elastic displacements at hand.
     */
    Change
    change_of(const ContactProblem &problem, const ContactState &state)
    {
      const ContactSystem &system = *problem.system;
      const VectorXd       v      = start_of(system, problem.gap);
      Change               change;
      if (system.form == Form::compliance)
        {
          change.of_load = problem.load - (v - multiply(system, state.r));
          return change;
        }
      const VectorXd u =
        problem.offset.size() > 0 && state.u.size() > 0 ? state.u : v;
      change.of_load = problem.load - (multiply(system, u) - state.r);
      change.offset_at_end =
        problem.offset.size() > 0 ? problem.offset : VectorXd::Zero(v.size());
      change.of_offset = change.offset_at_end - (v - u);
      return change;
    }

    /** Makes the next part as small as it must be to be held; whether none may
     * be. */
    bool
    is_at_limit(const LoadParts &parts, const ContactState &now, double &size)
    {
      if (!parts.is_too_much)
        return false;
      while (size > next_to_limit && parts.is_too_much(now, size))
        size = std::max(size / 2, next_to_limit);
      return size <= next_to_limit && parts.is_too_much(now, next_to_limit);
    }
  } // namespace



  Eigen::VectorXd
  start_of(const ContactSystem &system, const VectorXd &gap)
  {
    eigen_assert(gap.size() == system.n_nodes());
    VectorXd result = VectorXd::Zero(system.n_unknowns());
    for (Index i = 0; i < system.n_nodes(); ++i)
      result(system.normal(i)) = gap(i);
    return result;
  }



  LoadParts
  parts_from(const ContactState &state, const ContactProblem &problem)
  {
    LoadParts parts;
    parts.load = [&problem,
                  change = change_of(problem, state)](const double    done,
                                                      const VectorXd &slipped,
                                                      ContactProblem &part) {
      // What has slipped so far is part of the load of the next part.
      part.load = problem.load - (1 - done) * change.of_load;
      if (problem.system->form == Form::stiffness)
        part.offset =
          change.offset_at_end - (1 - done) * change.of_offset - slipped;
      else
        part.load -= slipped;
    };
    return parts;
  }



  /* Parts are halves to begin with, a quarter of one that fails, twice the size
     of one that is solved. The law knows its path: the end is not that of one
     step, which the report's substeps tell. */
  SolverReport
  solve_in_parts(const LoadParts      &parts,
                 const ContactProblem &problem,
                 ContactState         &state)
  {
    eigen_assert(parts.load && parts.solve);
    eigen_assert(parts.smallest > 0);
    const ContactSystem &system = *problem.system;
    SolverReport         report;
    ContactState         now  = state;
    VectorXd             slip = VectorXd::Zero(system.n_unknowns());
    ContactProblem       part = problem;
    double               done = 0, size = .5;
    report.substeps                    = 0;
    const LoadParts::Method *method    = &parts.solve;
    bool                     may_other = static_cast<bool>(parts.otherwise);
    while (done < 1)
      {
        if (is_at_limit(parts, now, size))
          {
            report.reason = "its limit is reached";
            break;
          }
        const double next  = std::min(1., done + size);
        ContactState trial = now;
        trial.v            = start_of(system, part.gap);
        parts.load(next, slip, part);
        const SolverReport one = (*method)(part, trial);
        add_work(report, one);
        if (one.converged && size / 4 >= parts.smallest && parts.is_doubtful &&
            parts.is_doubtful(now, trial))
          {
            size /= 4;
            continue;
          }
        if (!one.converged)
          {
            report.reason = one.reason;
            if (method == &parts.otherwise || (parts.stop && parts.stop()))
              break;
            size /= 4;
            if (size >= parts.smallest)
              continue;
            if (!std::exchange(may_other, false))
              break;
            size   = parts.smallest;
            method = &parts.otherwise;
            continue;
          }
        method          = &parts.solve;
        report.residual = std::max(report.residual, one.residual);
        report.solver   = one.solver;
        ++report.substeps;
        slip += slips_of(system, trial.v);
        for (Index i = 0; i < system.n_nodes(); ++i)
          part.gap(i) = trial.v(system.normal(i));
        now  = trial;
        done = next;
        size = std::min(2 * size, 1 - done);
      }
    // Slips of the parts add up; the gap is that of the last one.
    const auto take = [&] {
      state   = now;
      state.v = slip + start_of(system, part.gap);
    };
    report.converged = done >= 1;
    if (report.converged || (done > 0 && !system.large))
      take(); // or where the increment may have its limit
    std::ostringstream text;
    text.precision(4);
    if (!report.converged)
      text << report.reason << "; solved up to " << done
           << " of the load of this increment";
    report.reason = text.str();
    return report;
  }
} // namespace conetact::solvers
