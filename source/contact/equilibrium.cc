// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace conetact
{
  namespace
  {
    Tensor<1, 3>
    at_node(const Eigen::VectorXd &f,
            const Eigen::Index     dof,
            const unsigned int     dim)
    {
      Tensor<1, 3> force;
      for (unsigned int c = 0; c < dim; ++c)
        force[c] = f[dof + c];
      return force;
    }

    void
    add(Resultant &resultant, const Point<3> &p, const Tensor<1, 3> &force)
    {
      resultant.force += force;
      resultant.moment += cross_product_3d(Tensor<1, 3>(p), force);
    }

    /** Calls visit(global first dof, position) for each node of all bodies. */
    template <typename Visit>
    void
    for_each_node(const Bodies      &bodies,
                  const Coordinates &coordinates,
                  const Visit       &visit)
    {
      for (unsigned int body = 0; body < bodies.structures.size(); ++body)
        for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
          visit(coordinates.dof(body, i), bodies.structures[body]->position(i));
    }

    /** Sum of all resultants over the largest force and lever arm. */
    double
    balance_of(const Equilibrium &e, const double reach, const double floor)
    {
      Tensor<1, 3> force  = e.supports.force + e.loads.force;
      Tensor<1, 3> moment = e.supports.moment + e.loads.moment;
      double       largest =
        std::max({floor, e.supports.force.norm(), e.loads.force.norm()});
      for (const auto *side : {&e.contacts, &e.masters})
        for (const Resultant &contact : *side)
          {
            force += contact.force;
            moment += contact.moment;
            largest = std::max(largest, contact.force.norm());
          }
      if (largest == 0)
        return 0;
      return std::max(force.norm() / largest,
                      moment.norm() / (largest * reach));
    }
  } // namespace

  Tensor<1, 3>
  reaction_vector(const Coordinates     &coordinates,
                  const std::size_t      i,
                  const Eigen::VectorXd &r)
  {
    const NodeRule    &rule  = *coordinates.contact_rules()[i];
    const Eigen::Index first = coordinates.layout().first[i];
    Tensor<1, 3>       force;
    for (std::size_t k = 0; k < rule.dual.size(); ++k)
      force += r[first + static_cast<Eigen::Index>(k)] * rule.dual[k];
    return force;
  }

  Equilibrium
  check_equilibrium(const Bodies          &bodies,
                    const ElasticSystem   &elastic,
                    const Coordinates     &coordinates,
                    const Eigen::VectorXd &u,
                    const Eigen::VectorXd &r,
                    const Eigen::VectorXd &loads,
                    const double           t,
                    const std::size_t      n_contacts,
                    const double           reference_force)
  {
    Equilibrium           e;
    const unsigned int    dim      = bodies.dim;
    Eigen::VectorXd       internal = elastic.internal_forces(u);
    const Eigen::VectorXd ground   = elastic.ground_forces(t);

    Eigen::VectorXd unbalanced =
      coordinates.restrict(internal - loads - ground);
    unbalanced.tail(r.size()) -= r;

    Eigen::VectorXd rest = internal - loads - ground;
    coordinates.unhang(internal);
    e.contacts.resize(n_contacts);
    e.masters.resize(n_contacts);
    for (std::size_t i = 0; i < coordinates.contact_rules().size(); ++i)
      {
        const NodeRule    &rule  = *coordinates.contact_rules()[i];
        const Tensor<1, 3> force = reaction_vector(coordinates, i, r);
        const Eigen::Index dof   = coordinates.dof(rule.body, rule.node);
        add(e.contacts[rule.contact_node->contact],
            rule.contact_node->position,
            force);
        for (unsigned int c = 0; c < dim; ++c)
          rest[dof + c] -= force[c];
        const ContactNode &node = *rule.contact_node;
        for (const auto &[master, weight] : node.masters)
          {
            const Eigen::Index m = coordinates.dof(node.master, master);
            add(e.masters[node.contact],
                bodies.structures[node.master]->position(master),
                -weight * force);
            for (unsigned int c = 0; c < dim; ++c)
              rest[m + c] += weight * force[c];
          }
      }
    coordinates.unhang(rest);
    for (const NodeRule &rule : coordinates.rules().rules())
      if (!rule.held.empty())
        {
          const Eigen::Index dof = coordinates.dof(rule.body, rule.node);
          Tensor<1, 3>       force;
          for (const HeldDirection &held : rule.held)
            force +=
              (at_node(rest, dof, dim) * held.direction) * held.direction;
          add(e.supports,
              bodies.structures[rule.body]->position(rule.node),
              force);
        }

    const Eigen::VectorXd springs = ground - elastic.spring_forces(u);
    double                reach   = 0;
    for_each_node(
      bodies, coordinates, [&](const Eigen::Index dof, const Point<3> &p) {
        add(e.supports, p, at_node(springs, dof, dim));
        add(e.loads, p, at_node(loads, dof, dim));
        e.largest_force =
          std::max(e.largest_force, at_node(internal, dof, dim).norm());
        reach = std::max(reach, p.norm());
      });

    const double scale = std::max(e.largest_force, reference_force);
    if (scale > 0 && unbalanced.size() > 0)
      e.residual = unbalanced.cwiseAbs().maxCoeff() / scale;
    e.balance = balance_of(e, reach, scale);
    return e;
  }
} // namespace conetact
