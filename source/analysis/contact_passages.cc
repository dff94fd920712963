// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/contact_passages.h"

#include "conetact/base/text.h"

#include <algorithm>
#include <map>

namespace conetact::analysis
{
  namespace
  {
    /** How a node that enters an obstacle or a body on its way goes on. */
    enum class Way
    {
      right,      ///< out where it came in, or it does not enter
      round_edge, ///< held by another side: one that it slid to, or a wrong one
      through     ///< to the other side, or it was deep inside
    };

    constexpr double opposite_side = -.5, same_side = .5; // cosines
    constexpr double deep_enough = .25;                   // of a cell
    constexpr double closed      = 1e-6;                  // of a cell

    /**
     * Follows a node on its way, given at parts of it from 0 to 1, to where
     * `end` says. Gaps are distances, so that no obstacle is too thin to be
     * met.
     */
    template <typename NodeAt>
    Way
    way_of(const NodeAt &at, const pairing::ContactNode &end)
    {
      constexpr double     shortest = 1. / 64, longest = 1. / 8; // of the way
      constexpr double     touches = 1e-9;
      pairing::ContactNode before  = at(0);
      const double         length  = (end.moved - before.moved).norm();
      if (before.gap > length) // out of reach
        return Way::right;
      bool has_entered = false;
      for (double part = 0; part < 1 && !has_entered;)
        {
          part += std::clamp(before.gap / std::max(length, 1e-300),
                             shortest,
                             longest);
          pairing::ContactNode now  = part < 1 ? at(part) : end;
          const double         step = (now.moved - before.moved).norm();
          const bool           is_through =
            now.n * before.n < 0 && now.gap >= 0 && before.gap + now.gap < step;
          has_entered = is_through || now.gap < -touches * end.spacing;
          if (!has_entered)
            before = std::move(now);
        }
      if (!has_entered)
        return Way::right;
      double depth = 0; // of a cell
      for (double part = 0; part < 1; part += longest)
        depth = std::max(depth, -at(part).gap / end.spacing);
      const double cosine = before.n * end.n;
      if (cosine < opposite_side || depth > 1)
        return Way::through;
      return cosine < same_side && depth > deep_enough &&
                 end.gap < closed * end.spacing ?
               Way::round_edge :
               Way::right;
    }

    /** What holds a node of a pair at the end. */
    struct Held
    {
      Tensor<1, 3> n;       ///< 0: nothing
      double       gap = 0; ///< [length]
    };

    Way
    way_of(const pairing::SlidingContacts::PairPassage &passage,
           const Held                                  &held)
    {
      const double depth = passage.depth / passage.size;
      if (passage.is_out())
        {
          const double cosine = passage.entered * passage.left;
          if (cosine < opposite_side || depth > 1)
            return Way::through;
          return cosine < same_side && depth > deep_enough &&
                     held.n.norm_square() > 0 &&
                     held.gap < closed * passage.size ?
                   Way::round_edge :
                   Way::right;
        }
      if (!passage.is_slave) // in between nodes of the slave, see comes_between
        return depth > 1 || passage.depth > deep_enough * passage.thickness ?
                 Way::through :
                 Way::right;
      constexpr double unseen = .1; // of a cell
      const double     cosine = passage.entered * held.n;
      if (cosine >= same_side || depth <= unseen)
        return Way::right;
      return cosine < opposite_side || held.n.norm_square() == 0 ?
               Way::through :
               Way::round_edge;
    }

    bool
    is_wrong(const Way way, const bool may_be_cut)
    {
      return way == Way::through || (way == Way::round_edge && may_be_cut);
    }
  } // namespace

  ContactPassages::ContactPassages(const pairing::SlidingContacts &c,
                                   const contact::ContactModel    &m)
    : contacts(c)
    , model(m)
  {}

  ContactPassages::Ways
  ContactPassages::ways_to(const ContactStart    &start,
                           const Eigen::VectorXd &u) const
  {
    const auto &now = model.bodies.frames;
    Ways        ways;
    for (unsigned int b = 0; b < model.bodies.structures.size(); ++b)
      {
        const bodies::Structure &body = *model.bodies.structures[b];
        std::vector<Point<3>>    from, to;
        for (unsigned int i = 0; i < body.n_nodes(); ++i)
          {
            from.push_back(body.position(i));
            if (start.u.size() > 0)
              from.back() += model.displacement(start.u, b, i);
            to.push_back(body.position(i) + model.displacement(u, b, i));
          }
        Tensor<2, 3> turn = dealii::unit_symmetric_tensor<3>();
        if (b < now.size() && b < start.frames.size())
          turn = now[b].rotation * transpose(start.frames[b].rotation);
        ways.emplace_back(std::move(from), to, turn);
      }
    return ways;
  }

  std::string
  ContactPassages::pass_through(const ContactStart                &start,
                                const Eigen::VectorXd             &u,
                                const double                       t,
                                const bool                         may_be_cut,
                                pairing::SlidingContacts::Entries &inside) const
  {
    const Ways        ways = ways_to(start, u);
    const std::string why  = obstacle_passes(ways, start.t, t, may_be_cut);
    if (!why.empty())
      return why;
    inside = start.inside;
    return body_passes(ways, u, t, may_be_cut, inside);
  }

  std::string
  ContactPassages::obstacle_passes(const Ways  &ways,
                                   const double from,
                                   const double to,
                                   const bool   may_be_cut) const
  {
    for (const pairing::ContactNode &node : model.points.nodes())
      {
        if (!node.slides || node.obstacle == nullptr || node.is_bound() ||
            !node.is_active(to) || (node.layer && node.layer->wears()))
          continue;
        const auto at = [&](const double part) {
          return contacts.find_on_obstacle(
            node,
            [&](const unsigned int body, const unsigned int i) {
              return ways[body].at(i, part) -
                     model.bodies.structures[body]->position(i);
            },
            from + part * (to - from));
        };
        if (is_wrong(way_of(at, at(1)), may_be_cut))
          return "obstacle '" + node.obstacle->name + "' passes through " +
                 model.bodies.called(node.body) + " at " +
                 to_text(node.position) +
                 " (undeformed) and is behind it at the end. Use smaller "
                 "increments, or another path";
      }
    return "";
  }

  std::string
  ContactPassages::body_passes(const Ways                        &ways,
                               const Eigen::VectorXd             &u,
                               const double                       t,
                               const bool                         may_be_cut,
                               pairing::SlidingContacts::Entries &inside) const
  {
    const auto passages = contacts.passages(ways, inside);
    if (passages.empty())
      return "";
    const auto displacement = [&](const unsigned int body,
                                  const unsigned int i) {
      return model.displacement(u, body, i);
    };
    std::map<std::pair<unsigned int, unsigned int>, Held> held; // of a contact
    for (const pairing::ContactNode &node : model.points.nodes())
      if (!node.masters.empty())
        held[{node.contact, node.node}] = {
          node.n,
          node.gap + node.n * contact::difference_of_sides(node, displacement)};
    for (const auto &passage : passages)
      {
        const pairing::Contact &contact = contacts.contact(passage.contact);
        // What closes or wears is inside by that.
        if (contact.layer || !is_active(contact, t))
          continue;
        const auto found = passage.is_slave ?
                             held.find({passage.contact, passage.node}) :
                             held.end();
        if (is_wrong(way_of(passage,
                            found == held.end() ? Held() : found->second),
                     may_be_cut))
          return model.bodies.called(passage.other) + " passes through " +
                 model.bodies.called(passage.body) + " at " +
                 to_text(model.bodies.structures[passage.body]->position(
                   passage.node)) +
                 " (undeformed). Use smaller increments, finer meshes, or "
                 "another path";
      }
    return "";
  }

  /* The faces that it met at the start, moved on with their normal, would have
     it deep inside, but it is told to stand before others or none. */
  std::string
  ContactPassages::lose_masters(const ContactStart    &start,
                                const Eigen::VectorXd &u,
                                const double           t) const
  {
    constexpr double same_side = .5, deep = .1; // cosine; of a cell
    const auto       at = [&](const unsigned int body, const unsigned int i) {
      return model.displacement(u, body, i);
    };
    const auto &end = model.points.nodes();
    for (std::size_t i = 0; i < end.size(); ++i)
      {
        const pairing::ContactNode &then = start.nodes[i], &now = end[i];
        if (!now.slides || now.is_bound() || now.obstacle != nullptr ||
            then.masters.empty() || !now.is_active(t))
          continue;
        const double depth =
          -then.gap - then.n * contact::difference_of_sides(then, at);
        if (depth > deep * then.spacing &&
            (now.masters.empty() || now.n * then.n < same_side ||
             now.gap + now.n * contact::difference_of_sides(now, at) >
               deep * now.spacing))
          return "the node at " + to_text(now.position) + " of " +
                 model.bodies.called(now.body) + " is behind the faces of " +
                 model.bodies.called(then.master) + " that it met";
      }
    return "";
  }
} // namespace conetact::analysis
