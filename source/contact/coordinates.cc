// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/coordinates.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  Coordinates::Coordinates(const Bodies &b, const NodeRules &r)
    : bodies(b)
    , node_rules(r)
    , dof_offset(1, 0)
    , node_offset(1, 0)
  {
    for (const Structure *structure : bodies.structures)
      {
        dof_offset.push_back(dof_offset.back() + structure->n_dofs());
        node_offset.push_back(node_offset.back() + structure->n_nodes());
      }
    rule_of_node.resize(node_offset.back(), nullptr);
    for (const NodeRule &rule : node_rules.rules())
      rule_of_node[node_offset[rule.body] + rule.node] = &rule;
    number_unknowns();
    write_rows();
  }

  Eigen::Index
  Coordinates::dof(const unsigned int body, const unsigned int node) const
  {
    return dof_offset[body] + node * static_cast<Eigen::Index>(
                                       bodies.structures[body]->n_components());
  }

  std::pair<unsigned int, unsigned int>
  Coordinates::locate(const unsigned int node) const
  {
    unsigned int body = 0;
    while (node_offset[body + 1] <= node)
      ++body;
    return {body, node - node_offset[body]};
  }

  void
  Coordinates::number_unknowns()
  {
    first_unknown.resize(node_offset.back());
    first_contact.resize(node_offset.back(), -1);
    own_unknown.assign(static_cast<std::size_t>(n_dofs()), -1);
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        number_node(body, i);

    std::vector<double> mu;
    for (const ContactNode &node : bodies.contact_nodes)
      {
        const unsigned int global = node_offset[node.body] + node.node;
        const NodeRule    *rule   = rule_of_node[global];
        if (rule == nullptr || rule->contact.empty())
          continue;
        const auto n_own      = static_cast<Eigen::Index>(rule->contact.size());
        first_contact[global] = n_free + contact_layout.first.back();
        contact_layout.first.push_back(contact_layout.first.back() + n_own);
        mu.push_back(rule->mu);
        contacts.push_back(rule);
        node_of_unknown.insert(node_of_unknown.end(),
                               rule->contact.size(),
                               global);
      }
    set_n_unknowns(n_free + contact_layout.n_unknowns());
    contact_layout.mu =
      Eigen::Map<Eigen::VectorXd>(mu.data(),
                                  static_cast<Eigen::Index>(mu.size()));
  }

  void
  Coordinates::number_node(const unsigned int body, const unsigned int node)
  {
    const Structure   &structure = *bodies.structures[body];
    const std::size_t  n         = node_offset[body] + node;
    const NodeRule    *rule      = rule_of_node[n];
    const Eigen::Index before    = n_free;
    first_unknown[n]             = n_free;
    if (bodies.is_at_rest(body))
      return;
    if (rule != nullptr)
      n_free += static_cast<Eigen::Index>(rule->free.size());

    for (unsigned int c = rule != nullptr ? bodies.dim : 0;
         c < structure.n_components();
         ++c)
      if (structure.has_dof(node, c) &&
          !(rule != nullptr && rule->holds_rotation(c)))
        own_unknown[static_cast<std::size_t>(dof(body, node)) + c] = n_free++;
    node_of_unknown.insert(node_of_unknown.end(),
                           static_cast<std::size_t>(n_free - before),
                           static_cast<unsigned int>(n));
  }

  void
  Coordinates::write_rows()
  {
    reserve(static_cast<std::size_t>(n_dofs()));
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        for (unsigned int c = 0; c < bodies.structures[body]->n_components();
             ++c)
          {
            append_row(body, i, c, 1., 0);
            end_row();
          }
  }

  void
  Coordinates::append_own(const std::size_t  n,
                          const unsigned int c,
                          const double       factor)
  {
    const NodeRule &rule = *rule_of_node[n];
    const auto      add  = [&](const std::vector<Tensor<1, 3>> &directions,
                         const Eigen::Index               first) {
      for (std::size_t k = 0; k < directions.size(); ++k)
        if (directions[k][c] != 0)
          append(first + static_cast<Eigen::Index>(k),
                 factor * directions[k][c]);
    };
    add(rule.free, first_unknown[n]);
    add(rule.contact, first_contact[n]);
  }

  void
  Coordinates::append_row(const unsigned int body,
                          const unsigned int node,
                          const unsigned int c,
                          const double       factor,
                          const unsigned int depth)
  {
    if (bodies.is_at_rest(body))
      return;
    const std::size_t n    = node_offset[body] + node;
    const NodeRule   *rule = rule_of_node[n];
    if (rule == nullptr || c >= bodies.dim)
      {
        if (const Eigen::Index unknown =
              own_unknown[static_cast<std::size_t>(dof(body, node)) + c];
            unknown >= 0)
          append(unknown, factor);
        return;
      }
    if (depth > bodies.structures.size() + 2)
      throw InputError("Body '" + bodies.names[body] + "': its node at " +
                       to_text(bodies.structures[body]->position(node)) +
                       " follows other bodies in a circle of contacts. Let "
                       "Body and Master body change roles in one of them.");
    if (rule->masters.empty())
      append_own(n, c, factor);
    for (const auto &[master, weight] : rule->masters)
      append_row(body, master, c, factor * weight, depth + 1);
    if (rule->contact_node != nullptr)
      for (unsigned int d = 0; d < bodies.dim; ++d)
        if (const double part = rule->left_free(c, d); part != 0)
          for (const auto &[master, weight] : rule->contact_node->masters)
            append_row(rule->contact_node->master,
                       master,
                       d,
                       factor * part * weight,
                       depth + 1);
  }

  Eigen::VectorXd
  Coordinates::prescribed(const double t) const
  {
    const auto position = [&](const NodeRule &rule) {
      return bodies.structures[rule.body]->position(rule.node);
    };
    return along_held(
      [&](const NodeRule &rule, const HeldDirection &held) {
        return node_rules.displacement(held, position(rule), t);
      },
      [&](const NodeRule &rule, const NodeRule::HeldRotation &held) {
        return node_rules.angle(held, position(rule), t);
      });
  }

  Eigen::VectorXd
  Coordinates::held_part(const Eigen::VectorXd &u) const
  {
    return along_held(
      [&](const NodeRule &rule, const HeldDirection &held) {
        return at_node(u, rule.body, rule.node) * held.direction;
      },
      [&](const NodeRule &rule, const NodeRule::HeldRotation &held) {
        return u[dof(rule.body, rule.node) + held.component];
      });
  }

  Eigen::VectorXd
  Coordinates::along_held(const DisplacementOf &displacement,
                          const RotationOf     &rotation) const
  {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(n_dofs());
    for (const NodeRule &rule : node_rules.rules())
      {
        const Tensor<1, 3> u = along_held(rule.body, rule.node, displacement);
        const Eigen::Index first = dof(rule.body, rule.node);
        for (unsigned int c = 0; c < bodies.dim; ++c)
          d[first + c] = u[c];
        for (const NodeRule::HeldRotation &held : rule.rotations)
          d[first + held.component] = rotation(rule, held);
      }
    return d;
  }

  Tensor<1, 3>
  Coordinates::along_held(const unsigned int    body,
                          const unsigned int    node,
                          const DisplacementOf &displacement) const
  {
    Tensor<1, 3>    u;
    const NodeRule *rule = rule_of_node[node_offset[body] + node];
    if (rule == nullptr)
      return u;
    for (const auto &[master, weight] : rule->masters)
      u += weight * along_held(body, master, displacement);
    if (rule->contact_node != nullptr)
      for (const auto &[master, weight] : rule->contact_node->masters)
        u +=
          weight * along_held(rule->contact_node->master, master, displacement);
    for (const HeldDirection &held : rule->held)
      u += (displacement(*rule, held) - u * held.direction) * held.direction;
    return u;
  }

  Tensor<1, 3>
  Coordinates::at_node(const Eigen::VectorXd &u,
                       const unsigned int     body,
                       const unsigned int     node) const
  {
    Tensor<1, 3>       result;
    const Eigen::Index first = dof(body, node);
    for (unsigned int c = 0; c < bodies.dim; ++c)
      result[c] = u[first + c];
    return result;
  }

  void
  Coordinates::unhang(Eigen::VectorXd &f) const
  {
    for (const NodeRule &rule : node_rules.rules())
      if (!rule.masters.empty())
        for (unsigned int c = 0; c < bodies.dim; ++c)
          {
            double &force = f[dof(rule.body, rule.node) + c];
            for (const auto &[master, weight] : rule.masters)
              f[dof(rule.body, master) + c] += weight * force;
            force = 0;
          }
  }
} // namespace conetact
