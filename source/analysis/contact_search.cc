// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/contact_search.h"

#include "conetact/base/text.h"

#include <algorithm>

namespace conetact::analysis
{
  ContactSearch::ContactSearch(const pairing::SlidingContacts &c,
                               contact::ContactModel          &m)
    : contacts(c)
    , model(m)
    , frames(m.bodies.frames())
    , start_nodes(m.points.nodes())
  {}

  ContactSearch::Nodes
  ContactSearch::find_there(const Eigen::VectorXd &u, const double t) const
  {
    return contacts.find(
      model.points.nodes(),
      [&](const unsigned int body, const unsigned int node) {
        return model.displacement(u, body, node);
      },
      t);
  }

  ContactSearch::Nodes
  ContactSearch::linearised(Nodes nodes) const
  {
    contact::align_with_supports(model.bodies, nodes);
    contacts.linearise(nodes);
    return nodes;
  }

  ContactSearch::Nodes
  ContactSearch::find(const Eigen::VectorXd &u, const double t) const
  {
    return linearised(find_there(u, t));
  }

  ContactSearch::Nodes
  ContactSearch::find_between(const Eigen::VectorXd &u,
                              const double           t,
                              const double           part) const
  {
    Nodes nodes = find_there(u, t);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (const Tensor<1, 3> &last = model.points.nodes()[i].n;
          nodes[i].slides && nodes[i].n * last > 0)
        {
          nodes[i].n = last + part * (nodes[i].n - last);
          nodes[i].n /= nodes[i].n.norm();
        }
    return linearised(std::move(nodes));
  }

  /* Friction opposes the slip from one end of an increment to the other: a
     chord, which a turn by half a circle would reverse. */
  std::string
  ContactSearch::turns_too_far(const double t) const
  {
    constexpr double largest = 20; // degrees
    const auto      &nodes   = model.points.nodes();
    if (std::none_of(nodes.begin(), nodes.end(), [](const auto &node) {
          return node.slides && node.mu_1 + node.mu_2 > 0;
        }))
      return "";
    double     turn = 0;
    const auto note = [&](const Expression &angle) {
      turn =
        std::max(turn,
                 std::abs(angle(Point<3>(), t) - angle(Point<3>(), start_t)));
    };
    for (const bodies::Support &support : model.bodies.supports)
      if (support.turn)
        note(support.turn->angle);
    for (const pairing::ContactNode &node : nodes)
      if (node.slides && node.obstacle != nullptr && node.obstacle->turn)
        note(*node.obstacle->turn);
    return turn <= largest ?
             "" :
             "supports or obstacles Turn by " + to_text(turn) +
               " degrees, and friction knows the slip of an increment as a "
               "straight line only, also in parts of the increment. Use "
               "increments with turns of 20 degrees at most";
  }

  ContactSearch::Nodes
  ContactSearch::guess(const double t)
  {
    const contact::RigidMotions &motions = model.motions;
    Eigen::VectorXd              before  = motions.none(), deformed;
    model.bodies.move_frames()           = frames;
    if (start.size() > 0)
      {
        before   = motions.placement(start_t);
        deformed = model.coordinates.in_frames(start);
      }
    model.move_frames_with_supports(t);
    Eigen::VectorXd u = motions.field(motions.placement(t) - before);
    if (start.size() > 0)
      u += deformed;
    return find(model.coordinates.displacements(u), t);
  }

  ContactSearch::Change
  ContactSearch::change(const PendingIncrement &increment,
                        const Eigen::VectorXd  &u,
                        const Nodes            &found) const
  {
    const auto at = [&](const unsigned int body, const unsigned int node) {
      return model.displacement(u, body, node);
    };
    std::vector<double> forces;
    double              largest = 0;
    Change              worst;
    for (const contact::ContactPoint &point : model.points)
      {
        forces.push_back(contact::force_of(point, increment.state.r).norm());
        largest = std::max(largest, forces.back());
      }
    for (std::size_t i = 0; i < model.points.size(); ++i)
      {
        const pairing::ContactNode &node = *model.points[i].node;
        if (!node.slides)
          continue;
        const pairing::ContactNode &now =
          found[static_cast<std::size_t>(&node - model.points.nodes().data())];
        const double t    = increment.record.time;
        const bool   open = increment.state.node[i] == solvers::NodeState::open;
        pairing::FoundChange change = pairing::change_of(
          node,
          now,
          contact::relative_displacement(now, at, t),
          node.gap + node.n * contact::relative_displacement(node, at, t),
          open ? 0 : forces[i] / largest);
        if (node.obstacle != nullptr && !open)
          // an obstacle that turns moves otherwise at its other points
          change.force =
            std::max(change.force,
                     forces[i] / largest *
                       (contact::relative_displacement(now, at, t) -
                        contact::relative_displacement(node, at, t))
                         .norm() /
                       node.spacing);
        if (std::max(change.gap, change.force) >
            std::max(worst.gap, worst.force))
          worst.worst = &node;
        worst.gap   = std::max(worst.gap, change.gap);
        worst.force = std::max(worst.force, change.force);
      }
    return worst;
  }

  namespace
  {
    /** How a node that enters an obstacle on its way comes out of it. */
    enum class Way
    {
      right,      ///< where it came in, or it does not enter
      round_edge, ///< held by another side: one that it slid to, or a wrong one
      through     ///< on the other side, or it was deep inside
    };

    /**
     * Follows a node on its way, given at parts of it from 0 to 1, to where
     * `end` says. Gaps are distances, so that no obstacle is too thin to be
     * met.
     */
    template <typename NodeAt>
    Way
    way_of(const NodeAt               &at,
           const pairing::ContactNode &end,
           const bool                  may_be_deep)
    {
      constexpr double     shortest = 1. / 64, longest = 1. / 8; // of the way
      constexpr double     other_side = -.5, same_side = .5;     // cosines
      constexpr double     deep_enough = .25; // of a cell, as the others
      constexpr double     touches = 1e-9, closed = 1e-6;
      pairing::ContactNode before = at(0);
      const double         length = (end.moved - before.moved).norm();
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
      if (cosine < other_side || (may_be_deep && depth > 1))
        return Way::through;
      return cosine < same_side && depth > deep_enough &&
                 end.gap < closed * end.spacing ?
               Way::round_edge :
               Way::right;
    }
  } // namespace

  /* Between the ends of an increment displacements are taken as straight; for
     a body that turns they are not. */
  std::string
  ContactSearch::passes_through(const Eigen::VectorXd &u,
                                const double           t,
                                const bool             may_be_cut) const
  {
    constexpr double      no_turn = 1e-3;
    const Eigen::VectorXd from =
      start.size() > 0 ? start : Eigen::VectorXd::Zero(u.size());
    const auto &now      = model.bodies.frames();
    const auto  is_still = [&](const unsigned int body) {
      return body >= frames.size() ||
             (now[body].rotation - frames[body].rotation).norm() <= no_turn;
    };
    for (const pairing::ContactNode &node : model.points.nodes())
      {
        if (!node.slides || node.obstacle == nullptr)
          continue;
        const auto at = [&](const double part) {
          return contacts.find_on_obstacle(
            node,
            [&](const unsigned int body, const unsigned int i) {
              return Tensor<1, 3>((1 - part) *
                                    model.displacement(from, body, i) +
                                  part * model.displacement(u, body, i));
            },
            start_t + part * (t - start_t));
        };
        const Way way = way_of(at, at(1), is_still(node.body));
        if (way == Way::through || (way == Way::round_edge && may_be_cut))
          return "obstacle '" + node.obstacle->name + "' passes through " +
                 model.bodies.called(node.body) + " at " +
                 to_text(node.position) +
                 " and is behind it at the end. Use smaller increments, or "
                 "another path";
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
        if (!now.slides || now.obstacle != nullptr || then.masters.empty())
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

  void
  ContactSearch::take(Nodes found, contact::ContactHistory &history) const
  {
    model.relink(std::move(found));
    history.relink(start, start_t);
  }

  void
  ContactSearch::accept(const Eigen::VectorXd &u, const double t)
  {
    start       = u;
    start_t     = t;
    frames      = model.bodies.frames();
    start_nodes = model.points.nodes();
  }
} // namespace conetact::analysis
