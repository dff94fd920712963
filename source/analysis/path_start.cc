// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

/* How a load path starts: with what acts at t = 0, from nothing. */

#include "conetact/analysis/path_analysis.h"
#include "conetact/analysis/path_outcome.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    /** Loads below this part of the largest are rounding. */
    constexpr double of_loads = 1e-14;

    /**
     * Interferences that press less than this part of the first stage do, and
     * how many times more the loads do that they are applied with.
     */
    constexpr double small_interference = 1e-4, larger = 100;

    /** Over the spacing of nodes: smaller gaps are closed. */
    constexpr double touching = 1e-9;
  } // namespace

  /* A path follows rates, and there is none at which a body falls. */
  void
  PathAnalysis::refuse_falling() const
  {
    if (model.motions.unresisted().cols() == 0)
      return;
    std::vector<bool> touches(scene.bodies.names.size(), false);
    const auto        first = [&](const unsigned int body) {
      return model.motions.first_tied(body);
    };
    for (const contact::ContactPoint &point : model.points)
      if (const pairing::ContactNode &node = *point.node;
          node.gap <= touching * node.spacing)
        {
          touches[first(node.body)] = true;
          if (!node.masters.empty())
            touches[first(node.master)] = true;
        }
    for (const unsigned int body : model.motions.body_of_free())
      if (!touches[body])
        throw InputError("Solver/Method: body '" + scene.bodies.names[body] +
                         "' touches nothing at the start, so that it falls "
                         "under the first load. A load path needs bodies that "
                         "rest on their contacts: close the gap, add a "
                         "Support, or choose automatic.");
  }



  /* Bodies that are moved or turned until they touch miss each other by what
     their coordinates are known to, which must not press them. */
  Eigen::VectorXd
  gaps_at_start(const contact::ContactPoints &points,
                const application::Scene     &scene)
  {
    std::vector<double> reach;
    for (const auto &structure : scene.bodies.structures)
      reach.push_back(bodies::reach(*structure));
    Eigen::VectorXd gap(points.layout().n_nodes());
    Eigen::Index    i = 0;
    for (const contact::ContactPoint &point : points)
      {
        const pairing::ContactNode &node = *point.node;
        const double                size = node.masters.empty() ?
                                             reach[node.body] :
                                             std::max(reach[node.body], reach[node.master]);
        // half of what an equilibrium may miss a contact by
        gap[i++] = std::abs(node.gap) > .5 * solvers::position_rounding * size ?
                     node.gap :
                     0.;
      }
    return gap;
  }



  /* Displacements before anything acts. */
  Eigen::VectorXd
  PathAnalysis::unloaded()
  {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(system().n_unknowns());
    for (Eigen::Index i = 0; i < system().n_nodes(); ++i)
      v[system().normal(i)] = std::max(initial_gap[i], 0.);
    return v;
  }



  /* What acts at t = 0 is compared with all that acts later, and with the
     products that cancel in K (0, gap). */
  bool
  PathAnalysis::is_nothing(const Case &constant)
  {
    const Eigen::VectorXd v       = unloaded();
    const Eigen::VectorXd nothing = multiply(system(), v);
    const double          size    = solvers::largest(constant.f - nothing);
    double                largest = size;
    for (const double t : scene.times)
      largest = std::max(largest, solvers::largest(case_at(t).f - nothing));
    if (!v.isZero(0))
      largest = std::max(largest, (system().matrix.cwiseAbs() * v).maxCoeff());
    return size <= of_loads * largest;
  }



  /* Bodies that only contact holds rise until small interferences press
     nothing: no path leads there. They are applied with the first loads that
     press more, as an increment does. */
  double
  PathAnalysis::constant_until(const Case &constant)
  {
    if (system().null_space.cols() == 0 || is_nothing(constant) ||
        constant.forces.lpNorm<Eigen::Infinity>() > 0 ||
        solvers::largest(constant.load.prescribed) > 0)
      return 0;
    const double first = scene.times[0];
    const double press =
      solvers::largest(constant.f - multiply(system(), unloaded()));
    const double part = press / solvers::largest(case_at(first).f - constant.f);
    return part < small_interference ? larger * part * first : 0.;
  }



  /* From nothing: interferences are part of what is applied. */
  load_path::PathResult
  PathAnalysis::apply_constant_loads(load_path::PathFollower &follower,
                                     Case                    &constant,
                                     const double             t)
  {
    last.v                        = unloaded();
    last.r                        = Eigen::VectorXd::Zero(last.v.size());
    const Eigen::VectorXd nothing = multiply(system(), last.v);

    load_path::PathResult result;
    result.outcome = load_path::PathOutcome::target_reached;
    if (is_nothing(constant))
      {
        constant.f = nothing; // which the follower starts with
        return result;
      }
    constant_stage               = true;
    load_path::PathPoint reached = last;
    result                       = follower.follow(
      {nothing, constant.f - nothing, 0, 1},
      [&](const load_path::PathPoint &point) {
        for (const load_path::PathChange &change : point.changes)
          log.note(to_text(point.parameter) + " of the constant loads: node " +
                   node_name(change.node) + " " + state_name(change.from) +
                   " -> " + state_name(change.to));
        reached = point;
      });
    if (result.outcome != load_path::PathOutcome::target_reached &&
        result.outcome != load_path::PathOutcome::no_further_change)
      {
        last = reached;
        return result;
      }
    reached.changes.clear();
    constant_stage = false;
    if (t == 0)
      record(reached, constant, 0);
    last           = reached;
    last.parameter = t;
    return result;
  }
} // namespace conetact::analysis
