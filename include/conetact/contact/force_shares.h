// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_force_shares_h
#define conetact_contact_force_shares_h

#include "conetact/contact/contact_points.h"

#include <Eigen/Core>

#include <vector>

namespace conetact::contact
{
  /**
   * A contact node of which the force is not determined though the state is:
   * closed contacts that meet in the same nodes, such as those of a corner,
   * can exchange forces @f$\delta r@f$ with @f$H^T \delta r = 0@f$, where
   * sticking ones carry any force, slipping ones any length of theirs, and
   * those that carry nothing a normal force. Null: all forces are determined.
   * `states` and `r` of all points; whether the exchanged forces stay within
   * the cones is not asked, but where none is carried there is none to
   * exchange.
   */
  const pairing::ContactNode *
  undetermined_share(const ContactPoints                   &points,
                     const std::vector<solvers::NodeState> &states,
                     const Eigen::VectorXd                 &r);
} // namespace conetact::contact

#endif
