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
          found.emplace(
            node.contact,
            Left{model.bodies.called(node.body) + " rolls by " + to_text(turn) +
                 " rad at its contact node " + to_text(node.position) + why +
                 (node.slides ? ", and what else holds it (a tie, a spring, a "
                                "coupling, a bilateral contact) does not turn "
                                "with it. Use a smaller motion, hold it by "
                                "other means, or take what is off by as much "
                                "with Kinematics = small" :
                                "")});
        }
  }

  /* A body turns with a frame if all of its contacts slide. Without one it
     grows as it turns, by half of the square of the angle, which what is found
     on displaced faces sees, and presses by. */
  void
  SmallKinematics::add_beside_sliding(const IncrementEnd &end,
                                      Found              &found) const
  {
    constexpr double little = 2e-3; // rad: 2e-6 of what is round
    for (unsigned int b = 0; b < model.bodies.n_elastic(); ++b)
      {
        const double turn = turn_of(b, end).norm();
        if (!(turn > little))
          continue;
        const auto all     = contacts_of(b);
        const auto sliding = std::find_if(all.begin(), all.end(), [&](auto c) {
          return scene.contacts[c].slides;
        });
        const bool has_frame_then =
          std::all_of(all.begin(), all.end(), [&](auto c) {
            return scene.contacts[c].slides ||
                   scene.kinematics[c].why_not_finite.empty();
          });
        if (sliding == all.end() || !has_frame_then)
          continue;
        for (const unsigned int c : all)
          if (!scene.contacts[c].slides)
            found.emplace(c,
                          Left{model.bodies.called(b) + " turns by " +
                               to_text(turn) + " rad, and its contact '" +
                               scene.contact_names[*sliding] +
                               "' is found again where it comes to, which is "
                               "right if all contacts of the body are"});
      }
  }
} // namespace conetact::analysis
