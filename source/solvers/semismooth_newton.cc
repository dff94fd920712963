// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/semismooth_newton.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    /** A residual of more than this times the least one so far is no gain. */
    constexpr double progress_of_note = .98;

    /** No part of a step is shorter: it is halved five times at most. */
    constexpr double shortest = .02;

    /** The least residuals so far, relative and as forces: reactions that
     * vanish make relative ones large. Counts steps without much gain. */
    class Gains
    {
    public:
      Gains(const double residual, const double of_forces)
        : last(residual)
        , forces(of_forces)
        , least(residual)
        , least_force(std::isfinite(residual) ? residual * of_forces : residual)
      {}

      /** How much a step has gained: the ratio of residuals, and of forces
       * where these have fallen, too. */
      double
      see(const double residual, const double forces_now)
      {
        const double less = forces > 0 ? std::min(forces_now / forces, 1.) : 1.;
        const double gain = less * residual / last;
        const double force = residual * forces_now;
        const bool   gains = residual < progress_of_note * least ||
                           force < progress_of_note * least_force;
        stalls      = gains ? 0 : stalls + 1;
        unimproved  = gain < NewtonProgress::half ? 0 : unimproved + 1;
        least       = std::min(least, residual);
        least_force = std::min(least_force, force);
        last        = residual;
        forces      = forces_now;
        return gain;
      }

      unsigned int stalls     = 0; ///< steps since one has gained anything
      unsigned int unimproved = 0; ///< steps since one has halved the residual

    private:
      double last, forces, least, least_force;
    };

    /** Residuals that belong to states which have been there. */
    class SeenStates
    {
    public:
      void
      add(const std::string &states, const double residual)
      {
        seen.insert_or_assign(states, residual);
      }
      /** Whether they have been there, and nothing has been gained since. */
      bool
      come_again(const std::string &states, const double residual) const
      {
        const auto last_time = seen.find(states);
        return last_time != seen.end() &&
               residual > NewtonProgress::half * last_time->second;
      }

    private:
      std::map<std::string, double> seen;
    };
  } // namespace



  /* A node that slips again at once does not hold the body either. */
  std::optional<NewtonPoint>
  SemismoothNewton::holding_step(const NodeSets    &sets,
                                 const NewtonPoint &point,
                                 const double       precision,
                                 SolverReport      &report) const
  {
    std::optional<NewtonPoint> end =
      system.step(sets, point, precision, report);
    if (end && signature(sets_of_point(system.relation(), end->p, end->d)) ==
                 signature(point.sets))
      end.reset();
    return end;
  }



  /* A body that nothing holds goes the way in which it is driven until a node
     does not slip any further: one slips along its friction beyond that. */
  std::optional<NewtonPoint>
  SemismoothNewton::first_turned_step(const NewtonPoint &point,
                                      const double       precision,
                                      SolverReport      &report) const
  {
    const LinearRelation            &relation = system.relation();
    const std::optional<NewtonPoint> driven =
      system.forced_step(point.sets, point, precision, report);
    if (!driven)
      return {};
    const NodeSets sets =
      with_first_turned_stuck(relation,
                              point.sets,
                              relation.displacements(point.p, point.d),
                              relation.displacements(driven->p, driven->d));
    return signature(sets) == signature(point.sets) ?
             std::nullopt :
             holding_step(sets, point, precision, report);
  }



  /* Where nodes that hold a body all slip, as far as the sets know, the matrix
     is singular, though some of them may stick and hold it. So the strongest
     one is stuck, then the first one that would turn, then all of them; the
     last way is a step that makes what is left of the motion small. */
  std::optional<NewtonPoint>
  SemismoothNewton::full_step(const NewtonPoint &point,
                              const double       precision,
                              SolverReport      &report) const
  {
    const LinearRelation      &relation = system.relation();
    std::optional<NewtonPoint> end =
      system.step(point.sets, point, precision, report);
    if (end)
      return end;
    end =
      holding_step(with_strongest_stuck(relation,
                                        point.sets,
                                        relation.reactions(point.p, point.d)),
                   point,
                   precision,
                   report);
    if (!end)
      end = first_turned_step(point, precision, report);
    if (end)
      return end;
    const NodeSets stuck = without_slip(relation, point.sets);
    end                  = system.step(stuck, point, precision, report);
    return end ? end : system.forced_step(stuck, point, precision, report);
  }



  /* The shortest step is taken even if it gains nothing: it may lead out of a
     cycle. */
  NewtonPoint
  SemismoothNewton::shortened(const NewtonPoint &from, NewtonPoint to) const
  {
    NewtonPoint trial = to;
    for (double tau = .5;
         tau > shortest && !(trial.residual() < from.residual());
         tau /= 2)
      trial = system.between(from, to, tau);
    return system.refreshed(std::move(trial));
  }



  bool
  SemismoothNewton::step(NewtonPoint          &point,
                         const NewtonProgress &progress,
                         SolverReport         &report) const
  {
    std::optional<NewtonPoint> end =
      full_step(point, system.precision(point, progress), report);
    ++report.iterations;
    if (end && progress.damped)
      end = shortened(point, std::move(*end));
    if (!end || !std::isfinite(end->residual()))
      return false;
    point      = std::move(*end);
    point.sets = sets_of_point(system.relation(), point.p, point.d);
    return true;
  }



  /* Full steps converge quadratically once the states are right, but nothing
     makes residuals fall before that. So an iteration may rise for a while: it
     is watched for states that come again and for a residual that falls no
     more, and cut to steps that gain (damped) only then. It ends where the
     residual is below the goal and another step is worth nothing, where it is
     rounding, or where the same states do not change it any more. */
  std::string
  SemismoothNewton::iterate(NewtonPoint  &point,
                            SolverReport &report,
                            const Aim    &aim) const
  {
    const LinearRelation &relation = system.relation();
    const Patience        patience = system.patience();
    const auto forces = [&] { return relation.force_scale(point.p, point.d); };
    NewtonProgress progress;
    progress.goal   = aim.goal;
    progress.damped = aim.damped;
    Gains                      gains(point.residual(), forces());
    SeenStates                 seen;
    std::string                current = signature(point.sets);
    std::optional<NewtonPoint> settled; // as exact as rounding lets it be
    const auto                 is_done = [&] {
      const double residual = point.residual();
      return (residual <= aim.goal && !system.may_gain(point, progress)) ||
             (residual <= patience.noise && system.is_exact(progress)) ||
             (progress.same && gains.unimproved > patience.same_states);
    };
    while (!is_done())
      {
        if (options.stop && options.stop())
          return "stopped by the limit of time";
        if (report.iterations >= options.max_iterations)
          return stalled(point.residual());
        seen.add(current, point.residual());
        progress.iterations = report.iterations;
        if (!step(point, progress, report))
          return "singular tangent";

        const std::string next     = signature(point.sets);
        const double      residual = point.residual();
        progress.same              = next == current;
        progress.gain              = gains.see(residual, forces());
        progress.first             = false;
        const bool improved        = progress.has_improved();
        current                    = next;
        if (residual <= patience.noise &&
            (!settled || residual < settled->residual()))
          settled = point;
        if (settled && !improved && !system.may_gain(point, progress))
          {
            point = std::move(*settled);
            break;
          }
        // Full steps would go round in a cycle for ever.
        const bool cycles =
          !progress.same && !improved && seen.come_again(current, residual);
        if (cycles && (progress.damped ? gains.unimproved > patience.cycles :
                                         patience.leaves_cycles))
          return "cycling between state sets";
        const bool stalls = gains.stalls > patience.stalls;
        if (stalls && progress.damped)
          return stalled(residual);
        progress.damped = progress.damped || cycles || stalls;
      }
    return point.residual() <= aim.tolerance ? "" : stalled(point.residual());
  }



  SolverReport
  SemismoothNewton::run(const ContactProblem &problem,
                        NewtonPoint          &point,
                        ContactState         &state,
                        const Aim            &aim) const
  {
    SolverReport report;
    report.reason = iterate(point, report, aim);
    // With exact zeros the states need no tolerance.
    NewtonPoint exact = point;
    set_exact_zeros(system.relation(), exact.sets, exact.p, exact.d);
    system.write(exact, state);
    state.node       = classify(problem, state, 0);
    report.residual  = contact_residual(problem, state);
    report.converged = report.residual <= options.tolerance;
    if (report.converged)
      report.reason.clear();
    else if (report.reason.empty())
      report.reason = stalled(report.residual);
    return report;
  }
} // namespace conetact::solvers
