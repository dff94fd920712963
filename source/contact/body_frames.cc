// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/body_frames.h"

#include "conetact/base/errors.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::contact
{
  namespace
  {
    /** Ties of sides that are further apart than this, over the spacing of
     * nodes, do not turn: a gap that is kept would have to turn as well. */
    constexpr double tied_apart = 1e-9;

    /** Tells whether a tie goes on to be one where its bodies turn together. */
    bool
    turns_along(const pairing::ContactNode &tie, const model::Bodies &bodies)
    {
      return tie.is_tied() && !tie.masters.empty() && !tie.opening &&
             pairing::undeformed_distance(tie, bodies.structures).norm() <=
               tied_apart * tie.spacing;
    }

    /** Bodies that equations join turn together, or not at all. */
    std::vector<bool>
    together(const RigidMotions &motions, const std::vector<bool> &alone)
    {
      std::vector<bool> may = alone;
      for (unsigned int body = 0; body < alone.size(); ++body)
        for (unsigned int other = 0; other < alone.size(); ++other)
          if (motions.first_tied(body) == motions.first_tied(other))
            may[body] = may[body] && alone[other];
      return may;
    }

    /**
     * The body whose frame all that are tied to a body have. It is held by
     * supports alone, if one is: the others follow it by their ties, and turn
     * where these are strained.
     */
    unsigned int
    leader_of(const unsigned int   body,
              const model::Bodies &bodies,
              const RigidMotions  &motions)
    {
      const unsigned int first = motions.first_tied(body);
      const auto        &own   = motions.body_of_own();
      for (unsigned int other = first; other < bodies.structures.size();
           ++other)
        if (motions.first_tied(other) == first &&
            std::find(own.begin(), own.end(), other) == own.end())
          return other;
      return first;
    }

    [[noreturn]] void
    refuse_turn(const bodies::Support &support, const model::Bodies &bodies)
    {
      throw InputError(
        "Support '" + support.name + "', Turn: " + bodies.called(support.body) +
        " is held along some directions only, has a foundation, or contacts "
        "with Kinematics = small, which would stay where they are, or is "
        "tied to an obstacle, with a Preload, across a gap, or to such a "
        "body. Hold it by this support alone, and set Kinematics = finite "
        "sliding in its contacts.");
    }

    /**
     * Only contacts that slide, and supports that turn, let anything turn far.
     */
    bool
    may_go_far(const model::Bodies &bodies, const ContactPoints &points)
    {
      return points.slide() || std::any_of(bodies.supports.begin(),
                                           bodies.supports.end(),
                                           [](const auto &support) {
                                             return support.turn.has_value();
                                           });
    }
  } // namespace

  BodyFrames::BodyFrames(model::Bodies       &b,
                         const NodeRules     &r,
                         const ContactPoints &points,
                         const RigidMotions  &m)
    : bodies(b)
    , rules(r)
    , motions(m)
  {
    find(may_go_far(bodies, points));
  }

  /* Elements that turn have no frame here, and foundations and supports along
     some directions do not turn with the body. A free obstacle turns with what
     is tied to it; by itself its motion is that of amounts. */
  bool
  BodyFrames::may_turn(const unsigned int body) const
  {
    AssertIndexRange(body, bodies.structures.size());
    if (bodies.is_rigid(body))
      return bodies.is_free_obstacle(body) && is_driven(body);
    if (!bodies.deforms(body) ||
        bodies.structures[body]->n_components() > bodies.dim)
      return false;
    for (const bodies::Support &support : bodies.supports)
      if (support.body == body && support.stiffness)
        return false;
    for (const NodeRule &rule : rules.rules())
      if (rule.body == body && !rule.held.empty() &&
          rule.held.size() < bodies.dim)
        return false;
    return std::all_of(bodies.contact_nodes.begin(),
                       bodies.contact_nodes.end(),
                       [&](const pairing::ContactNode &node) {
                         return node.slides || turns_along(node, bodies) ||
                                (node.body != body &&
                                 (node.masters.empty() || node.master != body));
                       });
  }

  /* Of rotations about axes of the scene all may be held, or all but those
     about one axis, which stays where it is; or none. */
  bool
  BodyFrames::is_driven(const unsigned int obstacle) const
  {
    bool is_tied = false;
    for (const pairing::ContactNode &node : bodies.contact_nodes)
      if (!node.masters.empty() && node.master == obstacle)
        {
          if (!turns_along(node, bodies))
            return false;
          is_tied = true;
        }
    const NodeRule *const rule = rules.find(obstacle, 0);
    return is_tied &&
           (rule == nullptr || rule->rotations.size() != 1 || bodies.dim == 2);
  }

  void
  BodyFrames::find(const bool far)
  {
    bodies.frames.clear();
    std::vector<bool> may;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      may.push_back(may_turn(body));
    may = together(motions, may);
    for (const bodies::Support &support : bodies.supports)
      if (support.turn && !may[support.body])
        refuse_turn(support, bodies);
    if (!far)
      return;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        turns.push_back(may[body]);
        bodies.frames.emplace_back();
        bodies.frames.back().centre =
          motions.of_body(motions.none(), leader_of(body, bodies, motions))
            .centre;
      }
  }

  double
  BodyFrames::turn(const Eigen::VectorXd &amounts) const
  {
    Assert(turns.empty() || turns.size() == bodies.frames.size(),
           dealii::ExcMessage("Each body has a frame, or none has."));
    double largest = 0;
    for (unsigned int body = 0; body < turns.size(); ++body)
      if (turns[body] && leader_of(body, bodies, motions) == body)
        largest = std::max(largest, motions.rotation(amounts, body));
    return largest;
  }

  void
  BodyFrames::place(std::vector<pairing::RigidMotion> frames)
  {
    AssertDimension(frames.size(), bodies.frames.size());
    bodies.frames = std::move(frames);
  }

  /* x = c + d + Q (X - c): a small motion a + omega x (X - c), in components of
     the frame, makes d + Q a of d and Q exp(omega) of Q. What is tied has one
     frame: rigid motions leave ties alone. */
  void
  BodyFrames::move(const Eigen::VectorXd &amounts)
  {
    for (unsigned int body = 0; body < turns.size(); ++body)
      if (turns[body])
        {
          const RigidMotions::Motion more =
            motions.of_body(amounts, leader_of(body, bodies, motions));
          pairing::RigidMotion &frame = bodies.frames[body];
          frame.translation += frame.rotation * more.translation;
          frame.rotation =
            frame.rotation *
            pairing::RigidMotion::turned({}, more.rotation, {}).rotation;
        }
  }

  /* Placements are linear in the turn, and each is found in the frame that the
     one before has left: a few follow a far turn, until the rest is the
     rounding of an angle. */
  void
  BodyFrames::move_with_supports(const double t)
  {
    constexpr unsigned int most  = 50;
    constexpr double       small = 1e-14;
    for (unsigned int n = 0; n < most; ++n)
      {
        const Eigen::VectorXd placement = motions.placement(t);
        move(placement);
        if (turn(placement) <= small)
          return;
      }
  }

  /* Displacements that supports prescribe are told in frames: as differences of
     positions that are as far apart as this, whose rounding they have. */
  double
  BodyFrames::largest_way() const
  {
    double largest = 0;
    if (!bodies.frames.empty())
      for (const NodeRule &rule : rules.rules())
        largest = std::max(
          largest,
          bodies.displacement(rule.body, rule.node, Tensor<1, 3>()).norm());
    return largest;
  }
} // namespace conetact::contact
