// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_body_frames_h
#define conetact_contact_body_frames_h

#include "conetact/contact/rigid_motions.h"

#include <vector>

namespace conetact::contact
{
  /** Frames of the bodies that may turn far: who has one, and how they move. */
  class BodyFrames
  {
  public:
    /** Bodies::frames become those at the start. References must outlive the
     * object. Throws InputError where a Turn cannot be followed. */
    BodyFrames(model::Bodies       &bodies,
               const NodeRules     &rules,
               const ContactPoints &points,
               const RigidMotions  &motions);

    /** Whether a body may turn far. */
    bool
    has(const unsigned int body) const
    {
      return body < turns.size() && turns[body];
    }
    /** Largest angle by which amounts turn a body that has a frame [rad]. */
    double
    turn(const Eigen::VectorXd &amounts) const;
    /** How far frames have taken nodes that have rules, at most [length]. */
    double
    largest_way() const;

    /** They go on by these amounts; those of bodies without stay. */
    void
    move(const Eigen::VectorXd &amounts);
    /** They go where supports take bodies until time t. */
    void
    move_with_supports(const double t);
    /** They go where they were before. */
    void
    place(std::vector<pairing::RigidMotion> frames);

  private:
    bool
    may_turn(const unsigned int body) const;
    /** Whether a free obstacle is tied to bodies, and touches nothing else. */
    bool
    is_driven(const unsigned int obstacle) const;
    void
    find(const bool far);

    model::Bodies      &bodies;
    const NodeRules    &rules;
    const RigidMotions &motions;
    std::vector<bool>   turns; ///< of each body with a frame
  };
} // namespace conetact::contact

#endif
