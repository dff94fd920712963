// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/pairing/contact_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace conetact::pairing
{
  namespace
  {
    double
    value_at(const Expression  &expression,
             const Point<3>    &p,
             const std::string &entry)
    {
      const double value = expression(p);
      if (value < 0)
        throw InputError(entry + ": it is " + to_text(value) + " at " +
                         to_text(p) + ". Give a value of 0 or more.");
      return value;
    }

    /**
     * The growth of a Gap of t since the start, its mean over what the node is
     * a mean over. Of a way along the normals of bent faces the node sees
     * mean_cosine.
     */
    std::function<double(const double t)>
    growth_of(const ContactNode                            &node,
              const Contact                                &contact,
              const std::vector<const bodies::Structure *> &structures)
    {
      if (!contact.gap || !contact.gap->uses_time())
        return {};
      std::vector<std::pair<Point<3>, double>> places;
      for (const auto &[slave, weight] : node.slaves)
        places.emplace_back(structures[node.body]->position(slave), weight);
      if (places.empty())
        places.emplace_back(node.position, 1.);
      const Expression &gap  = *contact.gap;
      const double      seen = node.mean_cosine;
      return [places, &gap, seen](const double t) {
        double sum = 0;
        for (const auto &[p, weight] : places)
          sum += weight * (gap(p, t) - gap(p));
        return seen * sum;
      };
    }

    void
    set_friction(ContactNode &node, const Contact &contact)
    {
      const std::string in = "Contact '" + contact.name + "', ";
      node.friction_angle  = contact.friction_angle;
      node.mu_1            = value_at(contact.friction->expression(),
                           node.position,
                           in + "Friction coefficient");
      node.layer           = contact.layer;
      node.active          = contact.active;
      node.bond            = contact.bond;
      node.fluid           = contact.fluid;
      if (contact.layer)
        contact.layer->check(node.position);
      if (contact.bond)
        contact.bond->check(node.position);
      Situation here;
      here.position = node.position;
      if (const double most = contact.friction->largest_force(here, 1.);
          most < 0)
        throw InputError(in + "Shear limit: it is " + to_text(most) + " at " +
                         to_text(node.position) + ". Give 0 or more.");
      // Layers and wear ask for slips, with friction or without. The node's own
      // coefficient must be above 0 where a law gives another one.
      if (!contact.friction->is_constant() || contact.layer || contact.bond ||
          contact.fluid || contact.active || contact.spring)
        {
          node.friction = contact.friction;
          if (!contact.spring) // which has no sides that slip
            node.mu_1 = node.mu_1 > 0 ? node.mu_1 : 1.;
        }
      node.mu_2 = node.mu_1;
      if (contact.friction->is_elliptic())
        {
          const double second = value_at(contact.friction->expression(1),
                                         node.position,
                                         in + "Second friction coefficient");
          if (!node.friction)
            node.mu_2 = second;
          else // its law has both, along axes of one scale
            node.mu_1 = node.mu_2 = 1;
        }
      node.prestress =
        value_at(*contact.prestress, node.position, in + "Prestress");
      if (contact.path_cohesion)
        node.cohesion =
          value_at(*contact.path_cohesion, node.position, in + "Cohesion");
    }

    /**
     * The rounding of gaps, 16 eps of the largest coordinate: smaller ones are
     * none. A body that is turned with its master must not touch it node after
     * node.
     */
    double
    rounding_of_gaps(const Contact                                &contact,
                     const std::vector<const bodies::Structure *> &structures)
    {
      constexpr double eps = std::numeric_limits<double>::epsilon();
      if (contact.gap || contact.spring ||
          (contact.obstacle && contact.obstacle->shape->states_gaps()))
        return 0; // gaps that are written down
      const double other =
        contact.obstacle ? 0. : bodies::reach(*structures[contact.master]);
      return 16 * eps *
             std::max(bodies::reach(*structures[contact.body]), other);
    }

    /** Throws InputError for the deepest node that is too deep. */
    void
    check(const std::optional<PairedNodes::Deep> &deepest,
          const Contact                          &contact,
          const std::vector<std::string>         &bodies)
    {
      if (!deepest)
        return;
      const std::string depth = to_text(-deepest->gap);
      throw InputError(
        "Contact '" + contact.name + "': the node at " +
        to_text(deepest->position) + " of body '" + bodies[contact.body] +
        "' starts " + depth + " deep in " +
        (contact.obstacle ? "obstacle '" + contact.obstacle->name + "'" :
                            "body '" + bodies[contact.master] + "'") +
        ", more than " + to_text(deepest->allowed) +
        ". Move them apart, or for a press fit give " +
        (contact.obstacle ? "" : "the Gap or ") +
        "a Largest interference of at least " + depth + ".");
    }

    /** Two obstacles that a node meets along one normal: nothing tells which
     * of them carries it. */
    bool
    meet_the_same(const ContactNode &one, const ContactNode &other)
    {
      return one.obstacle != nullptr && other.obstacle != nullptr &&
             !one.spring && !other.spring && one.n * other.n > 1 - 1e-12;
    }

    /** Throws InputError where a body is inside of its obstacle: a normal that
     * is turned the wrong way. Outside, faces that slide may turn to it. */
    void
    refuse_inside(const Contact                  &contact,
                  const std::vector<std::string> &bodies,
                  const bodies::Structure        &body,
                  const PairedNodes              &found)
    {
      constexpr double away = .5; // as a cosine
      if (contact.obstacle == nullptr || contact.spring ||
          contact.obstacle->shape->states_gaps() || found.nodes.empty())
        return;
      const bodies::Surface surface = body.surface(contact.ids);
      if (surface.two_sided || surface.faces.empty())
        return;
      if (contact.slides &&
          std::all_of(found.nodes.begin(),
                      found.nodes.end(),
                      [](const ContactNode &node) { return node.gap > 0; }))
        return;
      std::map<unsigned int, Tensor<1, 3>> towards;
      for (const ContactNode &node : found.nodes)
        towards[node.node] = node.n;
      for (const bodies::SurfaceNode &node : surface.nodes)
        for (const Tensor<1, 3> &outward : node.normals)
          if (const auto at = towards.find(node.node);
              at != towards.end() && outward * at->second < away)
            return;
      throw InputError("Contact '" + contact.name + "': all faces of body '" +
                       bodies[contact.body] +
                       "' there look away from obstacle '" +
                       contact.obstacle->name +
                       "'. Turn its normal to the side of the body, or change "
                       "Boundary ids.");
    }

    /** Least distance of a node of one surface from one of the other. */
    double
    distance_of(const bodies::Surface &one, const bodies::Surface &other)
    {
      double least = std::numeric_limits<double>::max();
      for (const bodies::SurfaceNode &a : one.nodes)
        for (const bodies::SurfaceNode &b : other.nodes)
          least = std::min(least, a.position.distance(b.position));
      return least;
    }

    [[noreturn]] void
    refuse_nothing_bound(
      const Contact                                &contact,
      const std::vector<const bodies::Structure *> &structures)
    {
      const std::string kind =
        contact.kind == ContactKind::tie ? "tie" : "bilateral";
      throw InputError(
        "Contact '" + contact.name + "', Kind = " + kind +
        ": it binds nothing, for no node of the body faces the master within "
        "its Reach of " +
        to_text(contact.reach) + ". The nearest nodes of both sides are " +
        to_text(distance_of(structures[contact.body]->surface(contact.ids),
                            structures[contact.master]->surface(
                              contact.master_ids))) +
        " apart. Move the bodies, change boundary ids, or give a larger Reach "
        "or Largest angle.");
    }

    /**
     * What the log says of a contact: nodes, how many are paired, least and
     * largest gap.
     */
    Pairing
    count(const PairedNodes &found)
    {
      Pairing pairing{found.n_nodes, found.n_paired, 0, 0};
      bool    first = true;
      for (const ContactNode &node : found.nodes)
        {
          if (node.meets_nothing())
            continue;
          pairing.least_gap =
            first ? node.gap : std::min(pairing.least_gap, node.gap);
          pairing.largest_gap =
            first ? node.gap : std::max(pairing.largest_gap, node.gap);
          first = false;
        }
      return pairing;
    }
  } // namespace

  ContactNodes
  find_contact_nodes(const std::vector<Contact>                   &contacts,
                     const std::vector<std::string>               &bodies,
                     const std::vector<const bodies::Structure *> &structures,
                     const unsigned int                            dim)
  {
    ContactNodes                                                      result;
    std::multimap<std::pair<unsigned int, unsigned int>, std::size_t> known;
    for (unsigned int c = 0; c < contacts.size(); ++c)
      {
        const Contact    &contact  = contacts[c];
        const PairingRow &row      = pairing_of(contact, structures);
        PairedNodes       found    = row.pair(contact, structures);
        const double      rounding = rounding_of_gaps(contact, structures);
        for (ContactNode &node : found.nodes)
          if (std::abs(node.gap) <= rounding)
            node.gap = 0;
        refuse_inside(contact, bodies, *structures[contact.body], found);
        if (contact.kind != ContactKind::contact && found.n_paired == 0)
          refuse_nothing_bound(contact, structures);
        result.pairings.push_back(count(found));
        for (ContactNode &node : found.nodes)
          {
            node.contact = c;
            node.slides  = contact.slides;
            // Two contacts of a node are rows of their own, unless their
            // normals agree: then only the sum of the reactions is determined.
            const auto key          = std::make_pair(node.body, node.node);
            const auto [begin, end] = known.equal_range(key);
            for (auto other = begin; other != end; ++other)
              if (meet_the_same(result.nodes[other->second], node) &&
                  !contact.may_part() && // it leaves its place to the other
                  !contacts[result.nodes[other->second].contact].may_part())
                throw InputError(
                  "Contact '" +
                  contacts[result.nodes[other->second].contact].name +
                  "' and contact '" + contact.name +
                  "' both hold the node at " + to_text(node.position) +
                  " of body '" + bodies[contact.body] +
                  "' against obstacles with the same normal. A node stands in "
                  "several contacts where their normals differ: change "
                  "Boundary ids.");
            set_friction(node, contact);
            set_frame(node, node.n, dim);
            node.kind   = contact.kind;
            node.closes = contact.gap.has_value();
            node.growth = growth_of(node, contact, structures);
            known.emplace(key, result.nodes.size());
            result.nodes.push_back(std::move(node));
          }
        check(found.deepest, contact, bodies);
      }
    return result;
  }
} // namespace conetact::pairing
