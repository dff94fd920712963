// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What supports prescribe, in class Coordinates.

#include "conetact/contact/coordinates.h"

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <functional>

namespace conetact::contact
{
  namespace
  {
    /* What is along held directions, by their displacements and rotations. */
    using DisplacementOf =
      std::function<double(const NodeRule &, const HeldDirection &)>;
    using RotationOf =
      std::function<double(const NodeRule &, const NodeRule::HeldRotation &)>;

    Tensor<1, 3>
    node_along_held(const Coordinates    &coordinates,
                    const unsigned int    body,
                    const unsigned int    node,
                    const DisplacementOf &displacement)
    {
      Tensor<1, 3>    u;
      const NodeRule *rule = coordinates.rule(body, node);
      if (rule == nullptr)
        return u;
      // What hangs on a held node is moved with it.
      for (const auto &[master, weight] : rule->masters)
        u += weight * node_along_held(coordinates, body, master, displacement);
      for (const HeldDirection &held : rule->held)
        // Orthonormal directions: setting one leaves the others as they are.
        u += (displacement(*rule, held) - u * held.direction) * held.direction;
      return u;
    }

    Eigen::VectorXd
    along_held(const Coordinates    &coordinates,
               const unsigned int    dim,
               const DisplacementOf &displacement,
               const RotationOf     &rotation)
    {
      Eigen::VectorXd d = Eigen::VectorXd::Zero(coordinates.n_dofs());
      for (const NodeRule &rule : coordinates.rules().rules())
        {
          const Tensor<1, 3> u =
            node_along_held(coordinates, rule.body, rule.node, displacement);
          const Eigen::Index first = coordinates.dof(rule.body, rule.node);
          for (unsigned int c = 0; c < dim; ++c)
            d[first + c] = u[c];
          for (const NodeRule::HeldRotation &held : rule.rotations)
            d[first + held.component] = rotation(rule, held);
        }
      return d;
    }
  } // namespace

  Eigen::VectorXd
  Coordinates::prescribed(const double t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    const auto position = [&](const NodeRule &rule) {
      return bodies.structures[rule.body]->position(rule.node);
    };
    return along_held(
      *this,
      bodies.dim,
      [&](const NodeRule &rule, const HeldDirection &held) {
        return node_rules.displacement(rule, held, t);
      },
      [&](const NodeRule &rule, const NodeRule::HeldRotation &held) {
        return node_rules.angle(held, position(rule), t);
      });
  }

  /* The same walk along held directions as prescribed(), with u in place of
     what supports say: u - held_part(u) moves no support. */
  Eigen::VectorXd
  Coordinates::held_part(const Eigen::VectorXd &u) const
  {
    AssertDimension(u.size(), n_dofs());
    return along_held(
      *this,
      bodies.dim,
      [&](const NodeRule &rule, const HeldDirection &held) {
        return at_node(u, rule.body, rule.node) * held.direction;
      },
      [&](const NodeRule &rule, const NodeRule::HeldRotation &held) {
        return u[dof(rule.body, rule.node) + held.component];
      });
  }
} // namespace conetact::contact
