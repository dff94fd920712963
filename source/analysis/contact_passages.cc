// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/contact_search.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <limits>

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

  ContactSearch::Ways
  ContactSearch::ways_to(const Eigen::VectorXd &u) const
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
            if (start.size() > 0)
              from.back() += model.displacement(start, b, i);
            to.push_back(body.position(i) + model.displacement(u, b, i));
          }
        Tensor<2, 3> turn = dealii::unit_symmetric_tensor<3>();
        if (b < now.size() && b < frames.size())
          turn = now[b].rotation * transpose(frames[b].rotation);
        ways.emplace_back(std::move(from), to, turn);
      }
    return ways;
  }

  std::string
  ContactSearch::passes_through(const Eigen::VectorXd &u,
                                const double           t,
                                const bool             may_be_cut)
  {
    const Ways        ways = ways_to(u);
    const std::string why  = obstacle_passes(ways, t, may_be_cut);
    return why.empty() ? body_passes(ways, u, may_be_cut) : why;
  }

  std::string
  ContactSearch::obstacle_passes(const Ways  &ways,
                                 const double t,
                                 const bool   may_be_cut) const
  {
    for (const pairing::ContactNode &node : model.points.nodes())
      {
        if (!node.slides || node.obstacle == nullptr || node.is_bound() ||
            (node.layer && node.layer->wears()))
          continue;
        const auto at = [&](const double part) {
          return contacts.find_on_obstacle(
            node,
            [&](const unsigned int body, const unsigned int i) {
              return ways[body].at(i, part) -
                     model.bodies.structures[body]->position(i);
            },
            start_t + part * (t - start_t));
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
  ContactSearch::body_passes(const Ways            &ways,
                             const Eigen::VectorXd &u,
                             const bool             may_be_cut)
  {
    inside              = start_inside;
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
        if (contacts.contact(passage.contact).layer)
          continue; // what closes or wears is inside by that
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

  /* Downhill from the middle of the face, over the face. */
  double
  ContactSearch::lowest_gap(const ObstacleFace                           &face,
                            const pairing::SlidingContacts::Displacement &at,
                            const double                                  size,
                            const double t) const
  {
    constexpr double longest = .2, shortest = .01, level = 1e-3; // of size
    constexpr unsigned int most_steps = 100; // a face may be stretched by much
    pairing::ContactNode   node       = model.points.nodes()[face.node];
    const bodies::Structure &body     = *model.bodies.structures[node.body];
    node.slaves.clear(); // a point of the face
    std::vector<Point<3>> corners;
    Point<3>              p;
    for (const unsigned int i : face.corners)
      {
        corners.push_back(body.position(i) + at(node.body, i));
        p += Tensor<1, 3>(corners.back()) /
             static_cast<double>(face.corners.size());
      }
    const auto meet = [&](const Point<3> &x) {
      node.position = x;
      return contacts.find_on_obstacle(
        node,
        [&](const unsigned int b, const unsigned int i) {
          return b == node.body ? Tensor<1, 3>() : at(b, i);
        },
        t);
    };
    pairing::ContactNode lowest = meet(p);
    double               step   = longest * size;
    for (unsigned int k = 0; k < most_steps && step > shortest * size; ++k)
      {
        const Point<3> from = lowest.position;
        const Point<3> to =
          pairing::closest_point(corners,
                                 from - std::max(lowest.gap, step) * lowest.n)
            .point;
        if (to.distance(from) < level * size)
          break;
        if (pairing::ContactNode there = meet(to); there.gap < lowest.gap)
          lowest = std::move(there);
        else
          step /= 2;
      }
    return lowest.gap;
  }

  std::string
  ContactSearch::comes_between(const Eigen::VectorXd &u, const double t)
  {
    constexpr double deep = .1, deep_alone = .01; // of the size of a face
    const auto       at = [&](const unsigned int b, const unsigned int i) {
      return model.displacement(u, b, i);
    };
    const auto gap_of = [&](const pairing::ContactNode &node) {
      return node.gap + node.n * contact::relative_displacement(node, at, t);
    };
    std::set<unsigned int> touched; // contacts
    if (!obstacle_faces.empty())
      for (const pairing::ContactNode &node : model.points.nodes())
        if (gap_of(node) < closed * node.spacing)
          touched.insert(node.contact);
    for (const ObstacleFace &face : obstacle_faces)
      {
        const pairing::ContactNode &node = model.points.nodes()[face.node];
        const bodies::Structure    &body = *model.bodies.structures[node.body];
        double                      size = 0;
        for (const unsigned int i : face.corners)
          size = std::max(size, node.position.distance(body.position(i)));
        if (gap_of(node) > size)
          continue;
        const double gap = lowest_gap(face, at, size, t);
        // what a layer closes by is no depth, and neither is what has worn
        const double allowed =
          touched.count(node.contact) > 0 ? deep : deep_alone;
        if (gap - (node.layer ? std::min(gap_of(node), 0.) : 0.) <
            -allowed * size)
          return "obstacle '" + node.obstacle->name + "' is " + to_text(-gap) +
                 " deep in " + model.bodies.called(node.body) +
                 " beside its node " + to_text(node.position) +
                 ", in between its nodes, and only nodes touch. Use smaller "
                 "cells there";
      }
    return master_comes_between(u, deep);
  }

  /** How far two bodies at most have moved to each other since `from`. */
  double
  ContactSearch::approach(const Places &from, const Places &to) const
  {
    double      two = 0, one = 0;
    std::size_t i = 0;
    for (const bodies::Structure *const body : model.bodies.structures)
      {
        double moved = 0;
        for (const std::size_t end = i + body->n_nodes(); i < end; ++i)
          moved = std::max(moved, (to[i] - from[i]).norm());
        two = std::max(two, one + moved);
        one = std::max(one, moved);
      }
    return two;
  }

  /* Most increments are too small for it: seen from where it was looked for
     last. */
  std::string
  ContactSearch::master_comes_between(const Eigen::VectorXd &u,
                                      const double           deep)
  {
    constexpr double without_masters = std::numeric_limits<double>::max();
    if (clearance == without_masters)
      return "";
    const auto at = [&](const unsigned int b, const unsigned int i) {
      return model.displacement(u, b, i);
    };
    Places now;
    for (unsigned int b = 0; b < model.bodies.structures.size(); ++b)
      for (unsigned int i = 0; i < model.bodies.structures[b]->n_nodes(); ++i)
        now.push_back(at(b, i));
    if (!clear_at.empty() && approach(clear_at, now) < clearance)
      return "";
    const auto found = contacts.master_in_slave(at, deep);
    clearance        = found.clearance;
    if (clearance != without_masters)
      clear_at = std::move(now);
    if (!found.deep)
      return "";
    const pairing::Contact &contact = contacts.contact(found.deep->contact);
    if (contact.layer)
      return "";
    return "contact '" + contact.name +
           "': " + model.bodies.called(contact.master) + " is " +
           to_text(found.deep->depth) + " of a cell deep in " +
           model.bodies.called(contact.body) + " at its node " +
           to_text(model.bodies.structures[contact.master]->position(
             found.deep->node)) +
           " (undeformed), in between nodes of the slave. Choose the body of "
           "finer cells as slave (Body), or smaller cells";
  }

  /* An edge or a corner of the body may be pressed along any direction between
     the normals of its faces, whether these are in the contact or not. */
  double
  ContactSearch::angle_to_body(const pairing::ContactNode &node) const
  {
    const auto  &frames_now = model.bodies.frames;
    Tensor<1, 3> towards    = -node.n;
    if (node.body < frames_now.size())
      towards = transpose(frames_now[node.body].rotation) * towards;
    const auto angle = [&](const std::vector<Tensor<1, 3>> &normals) {
      return std::acos(
        std::min(1., pairing::nearest_in_cone(towards, normals).norm()));
    };
    double nearest = M_PI / 2;
    for (const Tensor<1, 3> &n : node.outward)
      nearest = std::min(nearest, angle({n}));
    if (nearest < M_PI / 12) // most often
      return nearest;
    const bodies::Structure &body  = *model.bodies.structures[node.body];
    const auto               nodes = body.surface(body.boundary_ids()).nodes;
    const auto               found =
      std::lower_bound(nodes.begin(),
                       nodes.end(),
                       node.node,
                       [](const auto &surface_node, const unsigned int number) {
                         return surface_node.node < number;
                       });
    if (found == nodes.end() || found->node != node.node)
      return nearest;
    return std::min(nearest, angle(found->normals));
  }

  std::string
  ContactSearch::meets_askew(const PendingIncrement &increment) const
  {
    constexpr double largest = M_PI / 6, little = 1e-2; // of the largest force
    double           scale = 0;
    for (const contact::ContactPoint &point : model.points)
      scale =
        std::max(scale, contact::force_of(point, increment.state.r).norm());
    for (const contact::ContactPoint &point : model.points)
      {
        const pairing::ContactNode &node = *point.node;
        if (node.obstacle == nullptr || node.outward.empty() ||
            contact::force_of(point, increment.state.r).norm() <=
              little * scale)
          continue;
        const double askew = angle_to_body(node);
        if (askew > largest)
          return "obstacle '" + node.obstacle->name + "' presses on " +
                 model.bodies.called(node.body) + " at the node " +
                 to_text(node.position) + " along " +
                 to_text(Point<3>(node.n)) + ", " +
                 to_text(askew * 180 / M_PI) +
                 " degrees off the body's normal there, as where an edge is in "
                 "between nodes: its reactions are as wrong. Use smaller cells "
                 "there, a rounded obstacle, or a body in its place";
      }
    return "";
  }

  /* The faces that it met at the start, moved on with their normal, would have
     it deep inside, but it is told to stand before others or none. */
  std::string
  ContactSearch::loses_masters(const Eigen::VectorXd &u) const
  {
    constexpr double same_side = .5, deep = .1; // cosine; of a cell
    const auto       at = [&](const unsigned int body, const unsigned int i) {
      return model.displacement(u, body, i);
    };
    const Nodes &end = model.points.nodes();
    for (std::size_t i = 0; i < end.size(); ++i)
      {
        const pairing::ContactNode &then = start_nodes[i], &now = end[i];
        if (!now.slides || now.is_bound() || now.obstacle != nullptr ||
            then.masters.empty())
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
