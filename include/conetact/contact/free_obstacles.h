// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_free_obstacles_h
#define conetact_contact_free_obstacles_h

#include "conetact/contact/node_rules.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace conetact::contact
{
  /**
   * Obstacles that loads press are rigid bodies behind the elastic ones: the
   * feet of contact nodes are their nodes, what is not free of them is held by
   * a support of their own at the reference point. They move by free motions
   * alone, which RigidMotions finds and which balance as those of bodies that
   * float: @f$G^T r + b = 0@f$. Takes what is prescribed from the obstacles;
   * contact nodes come to see rigid bodies as masters.
   */
  std::vector<std::unique_ptr<bodies::Structure>>
  add_free_obstacles(std::vector<pairing::Obstacle> &obstacles,
                     model::Bodies                  &bodies);

  /** The first dof of each body, behind them the number of all. */
  std::vector<Eigen::Index>
  first_dofs(const model::Bodies &bodies);

  /** Their forces and moments at time t, on all dofs of all bodies. */
  Eigen::VectorXd
  forces_on_free_obstacles(const std::vector<pairing::Obstacle> &obstacles,
                           const model::Bodies                  &bodies,
                           const double                          t);
} // namespace conetact::contact

#endif
