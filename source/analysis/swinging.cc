// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/swinging.h"

#include "conetact/contact/geometric_stiffness.h"

namespace conetact::analysis
{
  Swinging::Swinging(RunContext &r)
    : run(r)
  {}

  bool
  Swinging::may_help(const PendingIncrement &increment) const
  {
    return !is_on() && !run.model.bodies.frames.empty() &&
           contact::geometric_stiffness_of_loads(run.model,
                                                 *increment.mechanical)
               .size() > 0;
  }

  void
  Swinging::begin(const PendingIncrement &increment)
  {
    run.model.stiffen(
      contact::geometric_stiffness_of_loads(run.model, *increment.mechanical),
      run.model.motions.none());
  }

  void
  Swinging::stop()
  {
    run.model.stiffen({}, run.model.motions.none());
  }

  /* A frame stays where a motion is minus what the deformation moves its body
     by. Heat acts on no body as a whole. */
  void
  Swinging::go_on(const PendingIncrement &increment, const Eigen::VectorXd &w)
  {
    contact::ContactModel &model = run.model;
    const Eigen::VectorXd  heat  = *increment.forces - *increment.mechanical;
    model.stiffen(contact::geometric_stiffness(
                    model, model.elastic.internal_forces(w) - heat),
                  -model.motions.of_free(model.motions.free_in(w)));
  }

  bool
  Swinging::is_over(const PendingIncrement &increment) const
  {
    const double rounding =
      .01 * run.scene.solver.tolerance * run.history.largest_force();
    return !is_on() ||
           solvers::largest(run.model.geometric_forces(increment.motions)) <=
             rounding;
  }
} // namespace conetact::analysis
