// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/small_kinematics.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact::analysis
{
  Tensor<1, 3>
  SmallKinematics::turn_of(const unsigned int  body,
                           const IncrementEnd &end) const
  {
    return model.frames.has(body) ? Tensor<1, 3>() :
                                    model.motions.turn(end.amounts, body);
  }

  double
  SmallKinematics::rolled(const pairing::ContactNode &node,
                          const IncrementEnd         &end) const
  {
    const bool may_roll =
      node.obstacle == nullptr ?
        node.kind == pairing::ContactKind::contact :
        node.slides || scene.kinematics[node.contact].may_tilt();
    if (node.meets_nothing() || !may_roll)
      return 0;
    Tensor<1, 3> turn = turn_of(node.body, end);
    if (node.obstacle == nullptr)
      turn -= turn_of(node.master, end);
    const double rolled = (turn - (turn * node.n) * node.n).norm();
    return rolled == 0 || facets.at(node) == 0 ? 0 : rolled;
  }

  bool
  SmallKinematics::all_slips(const PendingIncrement &increment,
                             const unsigned int      contact) const
  {
    bool any = false;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (const contact::ContactPoint &point = model.points[i];
          point.node->contact == contact && point.mu > 0)
        {
          if (increment.state.node[i] == solvers::NodeState::stick)
            return false;
          any = any || increment.state.node[i] == solvers::NodeState::slip;
        }
    return any;
  }

  /* What a bore or a clamp encloses touches all round, what rolls does so along
     one normal. */
  bool
  SmallKinematics::encloses(const PendingIncrement &increment,
                            const unsigned int      contact) const
  {
    constexpr double along_one = .9; // of the length of a mean unit normal
    Tensor<1, 3>     sum;
    unsigned int     n = 0;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (const pairing::ContactNode &node = *model.points[i].node;
          node.contact == contact &&
          increment.state.node[i] != solvers::NodeState::open)
        {
          sum += node.n;
          ++n;
        }
    return sum.norm() < along_one * n;
  }

  bool
  SmallKinematics::is_free(const unsigned int body) const
  {
    const auto &own = model.motions.body_of_own();
    return std::find(own.begin(), own.end(), body) != own.end();
  }

  std::vector<unsigned int>
  SmallKinematics::to_slide_with(const pairing::ContactNode &node,
                                 const IncrementEnd         &end) const
  {
    std::vector<unsigned int> found, sides = {node.body};
    if (node.obstacle == nullptr)
      sides.push_back(node.master);
    for (const unsigned int body : sides)
      if (turn_of(body, end).norm() > 0)
        for (const unsigned int c : contacts_of(body))
          if (scene.contacts[c].slides)
            continue;
          else if (scene.kinematics[c].may_slide())
            found.push_back(c);
          else
            return {};
    return found;
  }

  /* Nodes that press keep pressing as a round body rolls, at the arm of their
     undeformed places: a moment that nothing real has. Facets hold a body
     until it has turned by half of one, and what spins in a bore with all of
     its friction used up. So it is with finite sliding where a body has no
     frame, for what it is tied to has none. */
  void
  SmallKinematics::add_rolled(const IncrementEnd &end, Found &found) const
  {
    constexpr double little = .05; // of what friction may do
    if (scene.path.follows)
      return;
    const auto closed = [&](const std::size_t i) {
      return end.increment.state.node[i] != solvers::NodeState::open;
    };
    std::map<unsigned int, bool> loose; // contacts that have been asked
    const auto is_loose = [&](const pairing::ContactNode &node) {
      if (loose.count(node.contact) == 0)
        loose[node.contact] = (is_free(node.body) || is_free(node.master)) &&
                              all_slips(end.increment, node.contact) &&
                              encloses(end.increment, node.contact);
      return loose[node.contact];
    };
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (const pairing::ContactNode &node = *model.points[i].node;
          closed(i) && found.count(node.contact) == 0)
        {
          const double turn = rolled(node, end), mu = model.points[i].mu;
          std::string  why;
          if (turn == 0)
            continue;
          if (turn > .5 * facets.at(node))
            why = ", more than half of what its faces turn by from one to the "
                  "next";
          else if (mu > 0 && turn > little * mu && node.obstacle != nullptr)
            why = ", which makes a moment beside that of its friction";
          else if (mu > 0 && turn > little * mu && is_loose(node))
            why = ", where all that touches slips: facets hold what friction "
                  "does not";
          else
            continue;
          Left left{model.bodies.called(node.body) + " rolls by " +
                    to_text(turn) + " rad at its contact node " +
                    to_text(node.position) + why};
          if (node.slides)
            left.with_it = to_slide_with(node, end);
          if (node.slides && left.with_it.empty())
            left.why += ", and what ties or couples it does not turn with it. "
                        "Use a smaller motion, or hold it by other means";
          found.emplace(node.contact, std::move(left));
        }
  }
} // namespace conetact::analysis
