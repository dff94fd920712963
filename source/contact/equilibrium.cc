// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace conetact
{
  namespace
  {
    /**
     * Where all nodal forces are smaller than this part of the terms |K||u|
     * they are summed up from, a body moves without force: what is left is the
     * rounding of its motion.
     */
    constexpr double no_force = 1e-10;

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

    /** Moment of the dofs that rotate: theta_z in 2D, x, y, z in 3D. */
    Tensor<1, 3>
    moment_at_node(const Eigen::VectorXd &f,
                   const Eigen::Index     dof,
                   const unsigned int     dim,
                   const unsigned int     n_components)
    {
      Tensor<1, 3> moment;
      for (unsigned int c = dim; c < n_components; ++c)
        moment[dim == 2 ? 2 : c - dim] = f[dof + c];
      return moment;
    }

    void
    add(Resultant &resultant, const Point<3> &p, const Tensor<1, 3> &force)
    {
      resultant.force += force;
      resultant.moment += cross_product_3d(Tensor<1, 3>(p), force);
    }

    /** Calls visit(body, first dof, position) for each node of all bodies. */
    template <typename Visit>
    void
    for_each_node(const Bodies      &bodies,
                  const Coordinates &coordinates,
                  const Visit       &visit)
    {
      for (unsigned int body = 0; body < bodies.structures.size(); ++body)
        {
          const Structure   &structure = *bodies.structures[body];
          const unsigned int n_nodes   = structure.n_nodes();
          Eigen::Index       dof       = coordinates.dof(body, 0);
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              visit(body, dof, structure.position(i));
              dof += structure.n_components();
            }
        }
    }

    /** Largest force of the scene's resultants. */
    double
    largest_resultant(const Equilibrium &e)
    {
      double largest = std::max(e.supports.force.norm(), e.loads.force.norm());
      for (const Resultant &contact : e.contacts)
        largest = std::max(largest, contact.force.norm());
      return largest;
    }

    /** A sum of forces that should vanish, over a force and a lever arm. */
    double
    relative(const Resultant &sum, const double force, const double arm)
    {
      return force == 0 ? 0. :
                          std::max(sum.force.norm() / force,
                                   sum.moment.norm() / (force * arm));
    }
    /**
     * Moments of dofs that rotate become forces at the end of a body's size, to
     * be judged with the others.
     */
    void
    divide_moments(const Bodies      &bodies,
                   const Coordinates &coordinates,
                   Eigen::VectorXd   &unbalanced)
    {
      for (unsigned int body = 0; body < bodies.structures.size(); ++body)
        {
          const Structure   &structure = *bodies.structures[body];
          const unsigned int n         = structure.n_components();
          if (n == bodies.dim)
            continue;
          double size = 0;
          for (unsigned int i = 0; i < structure.n_nodes(); ++i)
            size =
              std::max(size,
                       structure.position(i).distance(structure.position(0)));
          for (unsigned int i = 0; i < structure.n_nodes(); ++i)
            for (unsigned int c = bodies.dim; c < n; ++c)
              {
                const auto [begin, end] =
                  coordinates.row(coordinates.dof(body, i) + c);
                for (const auto *entry = begin; entry != end; ++entry)
                  unbalanced[entry->unknown] /= size;
              }
        }
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

    Eigen::VectorXd rest       = internal - loads - ground;
    Eigen::VectorXd unbalanced = coordinates.restrict(rest);
    unbalanced.tail(r.size()) -= r;
    e.unbalanced = unbalanced;
    divide_moments(bodies, coordinates, unbalanced);

    coordinates.unhang(internal);
    std::vector<Resultant> body_sum(bodies.structures.size());
    e.contacts.resize(n_contacts);
    e.masters.resize(n_contacts);
    const auto act = [&](Resultant          &resultant,
                         const unsigned int  body,
                         const Point<3>     &p,
                         const Tensor<1, 3> &force) {
      if (force.norm_square() == 0) // as on most nodes
        return;
      add(resultant, p, force);
      add(body_sum[body], p, force);
    };
    const auto take_from_rest = [&](const Eigen::Index  dof,
                                    const Tensor<1, 3> &force) {
      for (unsigned int c = 0; c < dim; ++c)
        rest[dof + c] -= force[c];
    };

    for (std::size_t i = 0; i < coordinates.contact_rules().size(); ++i)
      {
        const NodeRule    &rule  = *coordinates.contact_rules()[i];
        const ContactNode &node  = *rule.contact_node;
        const Tensor<1, 3> force = reaction_vector(coordinates, i, r);
        act(e.contacts[node.contact], node.body, node.position, force);
        take_from_rest(coordinates.dof(rule.body, rule.node), force);
        for (const auto &[master, weight] : node.masters)
          {
            act(e.masters[node.contact],
                node.master,
                bodies.structures[node.master]->position(master),
                -weight * force);
            take_from_rest(coordinates.dof(node.master, master),
                           -weight * force);
          }
      }
    coordinates.unhang(rest);

    for (const NodeRule &rule : coordinates.rules().rules())
      if (!rule.held.empty())
        {
          const Tensor<1, 3> force =
            at_node(rest, coordinates.dof(rule.body, rule.node), dim);
          Tensor<1, 3> reaction;
          for (const HeldDirection &held : rule.held)
            reaction += (force * held.direction) * held.direction;
          act(e.supports,
              rule.body,
              bodies.structures[rule.body]->position(rule.node),
              reaction);
        }
    for (const NodeRule &rule : coordinates.rules().rules())
      for (const NodeRule::HeldRotation &held : rule.rotations)
        {
          const unsigned int axis = dim == 2 ? 2 : held.component - dim;
          const double       moment =
            rest[coordinates.dof(rule.body, rule.node) + held.component];
          e.supports.moment[axis] += moment;
          body_sum[rule.body].moment[axis] += moment;
        }

    const Eigen::VectorXd springs = ground - elastic.spring_forces(u);
    double                reach   = 0;
    for_each_node(
      bodies,
      coordinates,
      [&](const unsigned int body, const Eigen::Index dof, const Point<3> &p) {
        act(e.supports, body, p, at_node(springs, dof, dim));
        act(e.loads, body, p, at_node(loads, dof, dim));
        const Tensor<1, 3> moment = moment_at_node(
          loads, dof, dim, bodies.structures[body]->n_components());
        e.loads.moment += moment;
        body_sum[body].moment += moment;
        // loads too: those on contact nodes need not strain anything
        e.largest_force = std::max({e.largest_force,
                                    at_node(internal, dof, dim).norm(),
                                    at_node(loads, dof, dim).norm()});
        reach           = std::max(reach, p.norm());
      });

    const auto judge = [&](const double scale) {
      if (scale > 0 && unbalanced.size() > 0)
        e.residual = unbalanced.cwiseAbs().maxCoeff() / scale;
      const double force = std::max(scale, largest_resultant(e));
      Resultant    sum;
      e.body_balance.clear();
      for (const Resultant &body : body_sum)
        {
          e.body_balance.push_back(relative(body, force, reach));
          sum.force += body.force;
          sum.moment += body.moment;
        }
      e.balance = relative(sum, force, reach);
    };
    const double scale = std::max(e.largest_force, reference_force);
    judge(scale);
    if (std::max(e.residual, e.balance) > 1e-12)
      if (const double terms = elastic.largest_terms(u);
          scale < no_force * terms)
        judge(1e-3 * terms);
    return e;
  }
} // namespace conetact
