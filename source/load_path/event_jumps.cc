// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Jumps of Coulomb's law, over a gap of the path to another equilibrium.

#include "conetact/load_path/event_follower.h"
#include "conetact/solvers/solver_table.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Steps beyond a point without continuation, in the length of the stage.
     */
    constexpr double jump_steps[] = {1e-8, 1e-6, 1e-4};
  } // namespace



  EventFollower::EventFollower(const EventFollower &path,
                               const Arrival       &unloading)
    : contact(path.contact)
    , options(path.options)
    , shared(path.shared)
    , system(*shared)
    , ratio_test(shared, PathLaw::holonomic)
    , now(path.now)
    , stage(path.stage)
    , load_rate(path.load_rate)
    , lower(-std::numeric_limits<double>::infinity())
    , upper(path.parameter)
    , parameter(path.parameter)
    , arrival(unloading)
    , last(path.last)
  {
    jumping     = true;
    options.law = PathLaw::holonomic;
    now.origin  = now.v;
  }



  /**
   * The whole problem from where the path stands, at a parameter just beyond,
   * by Lemke's method: what RateLcp says of rates holds for all slips from here
   * on, gaps and reactions, where no node has a state.
   */
  bool
  EventFollower::pivot_beyond(const double p)
  {
    VectorXd slipped = now.v;
    for (const Index n : system.normal)
      slipped(n) = 0;
    const VectorXd load =
      system.scale.cwiseProduct(stage.load) + (p - stage.begin) * load_rate;
    const RateLcp lcp(system,
                      Scheme(now.scheme.size()),
                      CriticalNodes(now.scheme.size(), {true, true, true}),
                      load - system.K * slipped);
    VectorXd      z;
    if (!lcp.solve(z, now.scheme))
      return false;
    now.v = slipped + lcp.displacements(z, 1);
    hold_scheme();
    return true;
  }



  /** Where the scheme is a mechanism in balance, rigid motions are held softly.
   */
  void
  EventFollower::hold_scheme()
  {
    factor = SchemeFactor(system, now.scheme, false);
    if (!factor.regular())
      factor = SchemeFactor(system, now.scheme, true);
  }



  /**
   * Solves the whole problem from where the path stands, at a parameter just
   * beyond, and takes the states of the result.
   */
  bool
  EventFollower::solve_beyond(const double p, std::string &reason)
  {
    VectorXd                slipped = system.scale.cwiseProduct(now.v);
    solvers::ContactState   state;
    solvers::ContactProblem problem;
    state.v        = slipped;
    state.r        = now.r.cwiseQuotient(system.scale);
    problem.system = contact;
    problem.gap.resize(system.n_nodes());
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index n  = system.normal[static_cast<std::size_t>(i)];
        problem.gap(i) = std::max(0., slipped(n));
        slipped(n)     = 0;
      }
    state.v -= slipped;
    // K (slipped + v) = r + f with the law on v alone.
    problem.load =
      stage.load + (p - stage.begin) * stage.rate - contact->matrix * slipped;
    solvers::SolverOptions solver_options;
    solver_options.tolerance = options.tolerance;
    const solvers::SolverReport report =
      solvers::make_solver(solver_options)->solve(problem, state);
    reason = report.reason;
    if (!report.converged)
      return false;
    for (std::size_t i = 0; i < now.scheme.size(); ++i)
      {
        const Index t        = system.tangent[i];
        now.scheme[i].closed = state.node[i] != solvers::NodeState::open;
        now.scheme[i].slip   = 0;
        if (t >= 0 && state.node[i] == solvers::NodeState::slip)
          now.scheme[i].slip = state.v(t) > 0 ? 1 : -1;
      }
    now.v = (slipped + state.v).cwiseQuotient(system.scale);
    hold_scheme();
    return true;
  }



  /** Takes an equilibrium as the end of a jump, if it is one. */
  bool
  EventFollower::land()
  {
    if (!(here().residual <= options.tolerance))
      return false;
    jumped       = true;
    now.critical = ratio_test.critical_nodes(now);
    arrival.reset();
    return true;
  }



  /**
   * Over a gap of the path to another equilibrium under the same load. What
   * slips from here on, slips one way: the holonomic law, counted from here.
   * Its path turns back where Coulomb's breaks off, and grows again.
   */
  bool
  EventFollower::jump_by_path()
  {
    const Arrival before = unloading();
    if (before.scheme.empty())
      return false;
    EventFollower     way_over(*this, before);
    const PathOutcome outcome = way_over.walk({}).outcome;
    if (outcome != PathOutcome::target_reached &&
        outcome != PathOutcome::no_further_change)
      return false;
    PathPosition there = way_over.now;
    there.origin       = now.origin;
    std::swap(now, there);
    std::swap(factor, way_over.factor);
    if (land())
      return true;
    std::swap(now, there);
    std::swap(factor, way_over.factor);
    return false;
  }



  /** The same by a full solve, at the same load if its states hold there, else
   * at the one just beyond for which it was found. */
  bool
  EventFollower::jump_by_solver(std::string &reason)
  {
    reason = "with cohesion there is no full solve";
    if (solvers::largest(system.cohesion) > 0)
      return false;
    const double       from   = parameter;
    const PathPosition before = now;
    for (const double step : jump_steps)
      for (const bool pivoting : {true, false})
        {
          const double beyond = from + step * (stage.end - stage.begin);
          if (pivoting ? pivot_beyond(beyond) : solve_beyond(beyond, reason))
            {
              // Best at the load where the path broke off: then nothing is
              // skipped.
              for (const double p : {from, beyond})
                {
                  move_to(p, VectorXd::Zero(now.v.size()));
                  if (land())
                    return true;
                }
              reason = "an equilibrium was found in several steps only";
            }
          now       = before;
          parameter = from;
        }
    return false;
  }



  bool
  EventFollower::jump(std::string &reason)
  {
    return jump_by_path() || jump_by_solver(reason);
  }
} // namespace conetact::load_path
