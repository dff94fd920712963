// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/held_nodes.h"

#include "conetact/base/text.h"
#include "conetact/contact/bound_nodes.h"
#include "conetact/contact/held_joints.h"
#include "conetact/pairing/node_weights.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>

namespace conetact::contact
{
  namespace
  {
    /** Normals that differ by more than 45 degrees belong to other sides of an
     * edge. */
    constexpr double cosine_of_side = .7;

    std::vector<bool>
    held_along_normals(const model::Bodies &bodies)
    {
      SupportedNodes    held = supported_nodes(bodies);
      const BoundNodes  bound(bodies.contact_nodes);
      std::vector<bool> result;
      for (const pairing::ContactNode &node : bodies.contact_nodes)
        {
          // What supports and ties hold together: a normal may be held by the
          // sum of both, and by neither alone.
          std::vector<Tensor<1, 3>> basis; // orthonormal
          for (const Tensor<1, 3> &e : held[{node.body, node.node}])
            add_direction(e, basis);
          bound.append(node, basis);
          result.push_back(is_spanned(node.n, basis));
        }
      return result;
    }

    /** Joins the row of `giver` to that of `taker`: slaves, masters and gap
     * become means over both areas, what is a force at each node is added. */
    void
    take(pairing::ContactNode &taker, const pairing::ContactNode &giver)
    {
      // A mean over both areas: sums of forces and a constant pressure are
      // kept.
      const double part = giver.area / (taker.area + giver.area);
      taker.slaves =
        pairing::mean_of(own_side(taker), 1 - part, own_side(giver), part);
      taker.masters =
        pairing::mean_of(taker.masters, 1 - part, giver.masters, part);
      taker.gap = (1 - part) * taker.gap + part * giver.gap;
      if (taker.growth && giver.growth)
        taker.growth =
          [part, own = taker.growth, other = giver.growth](const double t) {
            return (1 - part) * own(t) + part * other(t);
          };
      taker.area += giver.area;
      taker.prestress += giver.prestress;
      taker.cohesion += giver.cohesion;
    }
  } // namespace

  /* A held node gives its part to the nearest one (give_up_held_nodes). Which
     one that is would change as nodes slide, and with it rows of the contact:
     these nodes are refused. Those that meet nothing have nothing to give;
     where they come to a master, ContactPoints refuses them. */
  std::map<unsigned int, std::string>
  why_held_nodes_do_not_slide(const model::Bodies &bodies)
  {
    const auto &nodes  = bodies.contact_nodes;
    const auto  is_one = [](const pairing::ContactNode &node) {
      return node.is_mean && node.slides && !node.meets_nothing();
    };
    std::map<unsigned int, std::string> why;
    if (std::none_of(nodes.begin(), nodes.end(), is_one))
      return why;
    const std::vector<bool> held = held_along_normals(bodies);
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i] && is_one(nodes[i]))
        why.emplace(nodes[i].contact, why_it_does_not_slide(nodes[i], bodies));
    return why;
  }

  void
  give_up_held_nodes(model::Bodies &bodies)
  {
    std::vector<pairing::ContactNode> &nodes = bodies.contact_nodes;
    if (std::none_of(nodes.begin(),
                     nodes.end(),
                     [](const pairing::ContactNode &node) {
                       return node.is_mean;
                     }))
      return;
    const std::vector<bool>  held = held_along_normals(bodies);
    const std::size_t        none = nodes.size();
    std::vector<std::size_t> takers(nodes.size(), none);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      // What is bound gives up no node: which of its rows a support implies is
      // found where they are eliminated (BoundUnknowns). What is joined must
      // not part anywhere, and its mean with a neighbour could. What slides
      // and meets nothing is looked for again and again.
      if (held[i] && nodes[i].is_mean &&
          !(nodes[i].slides && nodes[i].meets_nothing()) &&
          !nodes[i].is_bound() && !nodes[i].may_part() && !nodes[i].bond)
        for (std::size_t j = 0; j < nodes.size(); ++j)
          if (!held[j] && nodes[j].contact == nodes[i].contact &&
              nodes[j].n * nodes[i].n > cosine_of_side &&
              (takers[i] == none ||
               nodes[j].position.distance(nodes[i].position) <
                 nodes[takers[i]].position.distance(nodes[i].position)))
            takers[i] = j; // the nearest on the same side of an edge
    std::vector<pairing::ContactNode> left;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      // All takers are chosen before anything is given. A node that is held
      // itself takes nothing, so that nothing is given twice.
      if (takers[i] != none)
        take(nodes[takers[i]], nodes[i]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (takers[i] == none)
        left.push_back(std::move(nodes[i]));
    nodes = std::move(left);
  }

  namespace
  {
    /** Over the spacing of nodes and the largest displacement: sides that part
     * by less do so by rounding. */
    constexpr double least_parting = 1e-6;

    std::size_t
    nearest_candidate(const pairing::ContactNode &node,
                      const ContactPoints        &points)
    {
      std::size_t nearest = points.size();
      for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].node->contact == node.contact &&
            (nearest == points.size() ||
             points[i].node->position.distance(node.position) <
               points[nearest].node->position.distance(node.position)))
          nearest = i;
      return nearest;
    }

    bool
    is_soft(const pairing::ContactNode &node)
    {
      return node.layer && node.layer->is_soft();
    }
  } // namespace

  HeldJoints::HeldJoints(const std::vector<std::string> &n,
                         const ContactModel             &m)
    : names(n)
    , model(m)
  {
    const auto        &nodes = model.points.nodes();
    std::vector<bool>  has_all(nodes.size(), false), has_rows(nodes.size());
    const unsigned int dim = model.bodies.dim;
    for (const ContactPoint &point : model.points.all())
      {
        const auto i = static_cast<std::size_t>(point.node - nodes.data());
        has_rows[i]  = true;
        has_all[i]   = point.dual.size() == dim;
      }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].may_part() && !has_all[i] && !is_soft(nodes[i]))
        ties.push_back(i);
      else if (nodes[i].bond && !has_rows[i])
        if (const std::size_t near = nearest_candidate(nodes[i], model.points);
            near < model.points.size())
          bonds.emplace_back(i, near);
  }

  Tensor<1, 3>
  HeldJoints::relative(const pairing::ContactNode &node,
                       const DisplacedAt          &at) const
  {
    if (at.u.size() == 0)
      return {};
    return relative_displacement(model, node, at.u, at.t);
  }

  /* Its sides stay as the increment finds them. */
  double
  HeldJoints::parted_tie(const pairing::ContactNode &node,
                         const DisplacedAt          &start,
                         const DisplacedAt          &end) const
  {
    return node.is_active(end.t) ?
             (relative(node, end) - relative(node, start)).norm() :
             0.;
  }

  /* Whatever was open at the start has no bond. */
  double
  HeldJoints::parted_bond(const pairing::ContactNode &node,
                          const DisplacedAt          &start,
                          const DisplacedAt          &end,
                          const bool                  sticks) const
  {
    if (!node.is_active(end.t) || node.gap > node.least_opening())
      return 0;
    pairing::Situation at;
    at.position              = node.position;
    at.t                     = end.t;
    const Tensor<1, 3> now   = relative(node, end);
    const Tensor<1, 3> moved = now - relative(node, start);
    double             way   = 0;
    if (node.bond->strength(at) > 0)
      way = std::max(node.gap + now * node.n, 0.);
    if (node.bond->cohesion(at) > 0 && sticks)
      way = std::max(way, (moved - (moved * node.n) * node.n).norm());
    return way;
  }

  std::string
  HeldJoints::sentence(const pairing::ContactNode &node, const double way) const
  {
    const NodeRule *const rule = model.rules.find(node.body, node.node);
    const std::string     by =
      rule != nullptr && !rule->held.empty() ?
            "support '" +
          model.bodies.supports[rule->held.back().terms.front().support].name +
          "'" :
            "another contact";
    return "contact '" + names[node.contact] + "': " + by +
           " holds the contact node at " + to_text(node.position) +
           " of body '" + model.bodies.names[node.body] + "', where the " +
           (node.bond ? "bond" : "tie") +
           " does not act then, and its sides part there by " + to_text(way) +
           ". Exchange slave and master (Body and Master body), or take the "
           "node out of the support or of the contact";
  }

  std::string
  HeldJoints::parted(const DisplacedAt                     &start,
                     const DisplacedAt                     &end,
                     const std::vector<solvers::NodeState> &states,
                     const std::vector<bool>               &whole) const
  {
    using solvers::NodeState;
    AssertDimension(states.size(), model.points.size());
    const auto  &nodes    = model.points.nodes();
    const double moved    = solvers::largest(end.u);
    const auto   is_apart = [&](const pairing::ContactNode &node,
                              const double                way) {
      return way > least_parting * std::min(node.spacing, moved);
    };
    for (const std::size_t i : ties)
      if (const double way = parted_tie(nodes[i], start, end);
          is_apart(nodes[i], way))
        return sentence(nodes[i], way);
    for (const auto &[i, near] : bonds)
      if (states[near] != NodeState::open && near < whole.size() && whole[near])
        if (const double way = parted_bond(
              nodes[i], start, end, states[near] == NodeState::stick);
            is_apart(nodes[i], way))
          return sentence(nodes[i], way);
    return "";
  }
} // namespace conetact::contact
