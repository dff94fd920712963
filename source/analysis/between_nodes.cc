// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/between_nodes.h"

#include "conetact/analysis/contact_passages.h"
#include "conetact/base/text.h"
#include "conetact/bodies/face_nodes.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace conetact::analysis
{
  namespace
  {
    constexpr double deep          = .1;   // of the size of a face, of a cell
    constexpr double nearly_closed = 1e-6; // of a cell
  }                                        // namespace

  BetweenNodes::BetweenNodes(const pairing::SlidingContacts &c,
                             const contact::ContactModel    &m)
    : contacts(c)
    , model(m)
  {
    find_obstacle_faces();
  }

  void
  BetweenNodes::find_obstacle_faces()
  {
    using Key = std::pair<unsigned int, unsigned int>; // contact, body
    std::map<Key, std::map<unsigned int, std::size_t>> nodes_of;
    const auto &all = model.points.nodes();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const pairing::ContactNode &node = all[i];
          node.obstacle != nullptr && !node.is_bound() &&
          !node.obstacle->shape->states_gaps())
        nodes_of[{node.contact, node.body}][node.node] = i;
    for (const auto &[key, nodes] : nodes_of)
      {
        const bodies::Structure &body = *model.bodies.structures[key.second];
        for (const auto &face :
             body.surface(contacts.contact(key.first).ids).faces)
          for (const auto &corners : bodies::parts_of_contacts(body, face))
            if (std::all_of(corners.begin(),
                            corners.end(),
                            [&, &of = nodes](const unsigned int corner) {
                              return of.count(corner) > 0;
                            }))
              obstacle_faces.push_back({nodes.at(corners[0]), corners});
      }
  }

  /* Downhill from the middle of the face, over the face. */
  double
  BetweenNodes::lowest_gap(const ObstacleFace                           &face,
                           const pairing::SlidingContacts::Displacement &at,
                           const double                                  size,
                           const double t) const
  {
    constexpr double longest = .2, shortest = .01, level = 1e-3; // of the face
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
  BetweenNodes::comes_between(const Eigen::VectorXd &u, const double t)
  {
    const auto at = [&](const unsigned int b, const unsigned int i) {
      return model.displacement(u, b, i);
    };
    const std::string why = obstacle_comes_between(at, t);
    return why.empty() ? master_comes_between(at, t) : why;
  }

  std::string
  BetweenNodes::obstacle_comes_between(
    const pairing::SlidingContacts::Displacement &at,
    const double                                  t) const
  {
    constexpr double deep_alone = .01; // of the size of a face
    const auto       gap_of     = [&](const pairing::ContactNode &node) {
      return node.gap + node.n * contact::relative_displacement(node, at, t);
    };
    std::set<unsigned int> touched; // contacts
    if (!obstacle_faces.empty())
      for (const pairing::ContactNode &node : model.points.nodes())
        if (gap_of(node) < nearly_closed * node.spacing)
          touched.insert(node.contact);
    for (const ObstacleFace &face : obstacle_faces)
      {
        const pairing::ContactNode &node = model.points.nodes()[face.node];
        const bodies::Structure    &body = *model.bodies.structures[node.body];
        double                      size = 0;
        for (const unsigned int i : face.corners)
          size = std::max(size, node.position.distance(body.position(i)));
        if (!node.is_active(t) || gap_of(node) > size)
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
    return "";
  }

  /** How far two bodies at most have moved to each other since `from`. */
  double
  BetweenNodes::approach(const Places &from, const Places &to) const
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

  BetweenNodes::Places
  BetweenNodes::places(const pairing::SlidingContacts::Displacement &at) const
  {
    Places now;
    now.reserve(model.coordinates.n_nodes());
    for (unsigned int b = 0; b < model.bodies.structures.size(); ++b)
      for (unsigned int i = 0; i < model.bodies.structures[b]->n_nodes(); ++i)
        now.push_back(at(b, i));
    return now;
  }

  /* Most increments are too small for it: seen from where it was looked for
     last. */
  std::string
  BetweenNodes::master_comes_between(
    const pairing::SlidingContacts::Displacement &at,
    const double                                  t)
  {
    constexpr double without_masters = std::numeric_limits<double>::max();
    if (clearance == without_masters)
      return "";
    if (!clear_at.empty() && approach(clear_at, places(at)) < clearance)
      return "";
    const auto found = contacts.master_in_slave(at, deep);
    clearance        = found.clearance;
    if (clearance != without_masters)
      clear_at = places(at);
    if (!found.deep)
      return "";
    const pairing::Contact &contact = contacts.contact(found.deep->contact);
    if (contact.layer || !is_active(contact, t))
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
} // namespace conetact::analysis
