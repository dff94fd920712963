// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/body_coordinates.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    using Directions = std::vector<Tensor<1, 3>>;

    /** An orthonormal basis of what supports leave of space, made of axes where
     * it can be. */
    Directions
    left_over(const NodeRule *rule, const unsigned int dim)
    {
      Directions held;
      if (rule != nullptr)
        for (const HeldDirection &h : rule->held)
          held.push_back(h.direction / h.direction.norm());
      return complement(held, dim);
    }

    bool
    is_held(const NodeRule *rule, const unsigned int component)
    {
      return rule != nullptr && rule->holds_rotation(component);
    }
  } // namespace

  /* The map u = B p of each body by itself: what supports hold is left out of
     p, what hangs follows its masters. Contacts do not change it where bodies
     meet each other: K_b stays when they slide, and only H is made anew. */
  BodyCoordinates::BodyCoordinates(const model::Bodies &b,
                                   const Coordinates   &c,
                                   const ContactPoints *points)
    : bodies(b)
    , coordinates(c)
  {
    if (points != nullptr)
      take(*points);
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        // Body after body: each has a block of its own in every matrix.
        first_unknown.push_back(static_cast<Eigen::Index>(unknowns.size()));
        const unsigned int n = bodies.structures[body]->n_nodes();
        first_of_node.resize(first_of_node.size() + n);
        end_of_node.resize(first_of_node.size());
        for (unsigned int node = 0; node < n; ++node)
          {
            const std::size_t number = coordinates.number(body, node);
            first_of_node[number]    = unknowns.size();
            if (bodies.deforms(body))
              add_node(body, node);
            end_of_node[number] = unknowns.size();
          }
      }
    first_unknown.push_back(static_cast<Eigen::Index>(unknowns.size()));
    set_n_unknowns(first_unknown.back());

    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        for (unsigned int k = 0; k < bodies.structures[body]->n_components();
             ++k)
          {
            append_row(body, i, k, 1.);
            end_row();
          }
  }

  /* In stiffness form the unknowns of a contact node are those of its contact,
     in the axes of normal and tangents: then K of the node is that of the
     contact. */
  void
  BodyCoordinates::take(const ContactPoints &points)
  {
    for (const ContactPoint &point : points)
      {
        Assert(point.node->masters.empty() && point.node->slaves.empty(),
               dealii::ExcMessage("Its node faces an obstacle only."));
        const std::size_t number =
          coordinates.number(point.node->body, point.node->node);
        if (point_of_node.size() <= number)
          point_of_node.resize(number + 1, nullptr);
        Assert(point_of_node[number] == nullptr,
               dealii::ExcMessage("A node is in one contact."));
        point_of_node[number] = &point;
      }
  }

  void
  BodyCoordinates::add_node(const unsigned int body, const unsigned int node)
  {
    const NodeRule *rule = coordinates.rule(body, node);
    // Hanging nodes follow their masters, but for their rotations.
    if (rule == nullptr || rule->masters.empty())
      add_translations(body, node);
    add_rotations(body, node);
  }

  /* Held directions are prescribed: only what is left of space has unknowns. */
  void
  BodyCoordinates::add_translations(const unsigned int body,
                                    const unsigned int node)
  {
    const unsigned int number = coordinates.number(body, node);
    const auto         add    = [&](const Directions &directions) {
      for (const Tensor<1, 3> &e : directions)
        unknowns.push_back(
          {number, coordinates.dof(body, node), bodies.dim, e});
    };
    if (number < point_of_node.size() && point_of_node[number] != nullptr)
      {
        // Directions of the contact come last, in the order in which solvers
        // want them; those without friction are condensed with the rest.
        add(point_of_node[number]->frictionless);
        add(point_of_node[number]->directions);
      }
    else
      add(left_over(coordinates.rule(body, node), bodies.dim));
  }

  void
  BodyCoordinates::add_rotations(const unsigned int body,
                                 const unsigned int node)
  {
    const bodies::Structure &structure = *bodies.structures[body];
    const NodeRule          *rule      = coordinates.rule(body, node);
    const unsigned int       dim = bodies.dim, n = structure.n_components();
    for (unsigned int c = dim; c < n; ++c)
      if (structure.has_dof(node, c) && !is_held(rule, c))
        {
          Tensor<1, 3> direction;
          direction[c - dim] = 1;
          unknowns.push_back({coordinates.number(body, node),
                              coordinates.dof(body, node) + dim,
                              n - dim,
                              direction});
        }
  }

  /* The row of a dof: u_c = sum_k p_k (e_k)_c over the unknowns along e_k of
     its node. */
  void
  BodyCoordinates::append_row(const unsigned int body,
                              const unsigned int node,
                              const unsigned int component,
                              const double       factor)
  {
    AssertIndexRange(body, bodies.structures.size());
    AssertIndexRange(node, bodies.structures[body]->n_nodes());
    const NodeRule *rule = coordinates.rule(body, node);
    // The rows of masters in place of the node's own, as in Coordinates.
    if (rule != nullptr && component < bodies.dim)
      for (const auto &[master, weight] : rule->masters)
        append_row(body, master, component, factor * weight);
    const std::size_t  number = coordinates.number(body, node);
    const Eigen::Index dof    = coordinates.dof(body, node) + component;
    for (std::size_t p = first_of_node[number]; p < end_of_node[number]; ++p)
      {
        // Translations and rotations of a node have unknowns of their own; each
        // spans its own components.
        const Eigen::Index c = dof - unknowns[p].dof;
        if (c < 0 || c >= unknowns[p].n_components)
          continue;
        if (const double part = unknowns[p].direction[static_cast<unsigned>(c)];
            part != 0)
          append(static_cast<Eigen::Index>(p), factor * part);
      }
  }

  /* The directions of a node are orthonormal: p is a projection. */
  Eigen::VectorXd
  BodyCoordinates::values(const Eigen::VectorXd &u) const
  {
    AssertDimension(u.size(), coordinates.n_dofs());
    Eigen::VectorXd p(n_unknowns());
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      {
        const Unknown &unknown = unknowns[i];
        double         sum     = 0;
        for (unsigned int c = 0; c < unknown.n_components; ++c)
          sum += unknown.direction[c] * u[unknown.dof + c];
        p[static_cast<Eigen::Index>(i)] = sum;
      }
    return p;
  }
} // namespace conetact::contact
