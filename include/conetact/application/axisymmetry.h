// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_axisymmetry_h
#define conetact_application_axisymmetry_h

#include "conetact/bodies/structure.h"
#include "conetact/contact/node_rules.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/obstacles.h"

#include <string>
#include <vector>

namespace conetact::application
{
  /**
   * In a scene of bodies of revolution all that acts goes round the axis:
   * bodies, and obstacles that move along it only. Throws InputError where
   * something does not, where a contact lies on the axis or slides far.
   */
  void
  check_axisymmetric(const std::vector<std::string>               &names,
                     const std::vector<const bodies::Structure *> &structures,
                     const std::vector<pairing::Obstacle>         &obstacles,
                     const std::vector<pairing::Contact>          &contacts);

  /** Bodies of revolution stay on their axis: a support of each. */
  void
  hold_axes(model::Bodies &bodies);
} // namespace conetact::application

#endif
