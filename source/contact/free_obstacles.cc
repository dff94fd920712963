// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/free_obstacles.h"

#include "conetact/base/errors.h"
#include "conetact/bodies/rigid_body.h"

#include <algorithm>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    /**
     * The feet of all nodes that meet the obstacle become its nodes, behind
     * node 0, its reference point. Nodes that span its axes tell how it has
     * moved. Feet of nodes that slide are means over these: they go wherever
     * the obstacle may be met later.
     */
    std::unique_ptr<bodies::Structure>
    make_body(const pairing::Obstacle &obstacle, model::Bodies &bodies)
    {
      std::vector<Point<3>>               feet;
      std::vector<pairing::ContactNode *> sliding;
      for (pairing::ContactNode &node : bodies.contact_nodes)
        if (node.obstacle == &obstacle)
          {
            feet.push_back(node.foot());
            node.master  = static_cast<unsigned int>(bodies.structures.size());
            node.masters = {{static_cast<unsigned int>(feet.size()), 1.}};
            if (node.slides)
              sliding.push_back(&node);
          }
      auto body = std::make_unique<bodies::RigidBody>(
        bodies.dim, obstacle.reference, feet, bodies.are_axisymmetric());
      body->span();
      for (pairing::ContactNode *node : sliding)
        node->masters = body->weights_of(node->foot());
      return body;
    }

    /** A support prescribes the components that are not free: it takes over the
     * displacement of the obstacle, and holds rotations. */
    bodies::Support
    make_support(pairing::Obstacle &obstacle, const model::Bodies &bodies)
    {
      bodies::Support support;
      support.name = obstacle.name;
      support.body = static_cast<unsigned int>(bodies.structures.size());
      support.surface.nodes.push_back({0, obstacle.reference, 0, {}, {}});
      for (unsigned int c = 0; c < bodies.dim; ++c)
        if (!obstacle.free.components.at(c))
          {
            Tensor<1, 3> axis;
            axis[c] = 1;
            support.directions.push_back(axis);
            support.displacement.push_back(
              obstacle.displacement.empty() ?
                Expression("0", obstacle.name) :
                std::move(obstacle.displacement[c]));
          }
      obstacle.displacement.clear(); // the support's from here on
      // Components are x, y, z, rx, ry, rz: in the plane only the last one of
      // the rotations is left, about z.
      for (unsigned int c = bodies.dim == 2 ? 5 : 3; c < 6; ++c)
        if (!obstacle.free.components.at(c))
          support.rotations.push_back(
            {bodies.dim == 2 ? 2 : c, Expression("0", obstacle.name)});
      return support;
    }
  } // namespace

  std::vector<std::unique_ptr<bodies::Structure>>
  add_free_obstacles(std::vector<pairing::Obstacle> &obstacles,
                     model::Bodies                  &bodies)
  {
    std::vector<std::unique_ptr<bodies::Structure>> made;
    for (pairing::Obstacle &obstacle : obstacles)
      if (obstacle.free.any())
        {
          if (std::count(bodies.names.begin(),
                         bodies.names.end(),
                         obstacle.name) > 0)
            throw InputError("Obstacle '" + obstacle.name +
                             "', Free: a body has the same name, and an "
                             "obstacle that is free stands beside bodies in "
                             "tables. Give it another one.");
          made.push_back(make_body(obstacle, bodies));
          bodies.supports.push_back(make_support(obstacle, bodies));
          bodies.names.push_back(obstacle.name);
          bodies.structures.push_back(made.back().get());
          ++bodies.n_rigid;
        }
    return made;
  }

  /* Of each body, and behind the last one their number. */
  std::vector<Eigen::Index>
  first_dofs(const model::Bodies &bodies)
  {
    std::vector<Eigen::Index> first = {0};
    for (const bodies::Structure *structure : bodies.structures)
      first.push_back(first.back() + structure->n_dofs());
    return first;
  }

  Eigen::VectorXd
  forces_on_free_obstacles(const std::vector<pairing::Obstacle> &obstacles,
                           const model::Bodies                  &bodies,
                           const double                          t)
  {
    const std::vector<Eigen::Index> first = first_dofs(bodies);
    Eigen::VectorXd                 f     = Eigen::VectorXd::Zero(first.back());
    std::size_t                     body  = bodies.n_elastic();
    for (const pairing::Obstacle &obstacle : obstacles)
      if (obstacle.free.any())
        {
          // The dofs of the first node are translations first, then rotations.
          Eigen::Index dof = first[body++];
          for (const auto *values :
               {&obstacle.free.force, &obstacle.free.moment})
            for (const Expression &value : *values)
              f[dof++] = value(Point<3>(), t);
        }
    return f;
  }
} // namespace conetact::contact
