// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/rigid_motion.h"

#include "conetact/bodies/placement.h"

#include <cmath>

namespace conetact::pairing
{
  RigidMotion
  RigidMotion::translated(const Tensor<1, 3> &d)
  {
    RigidMotion motion;
    motion.translation = d;
    return motion;
  }

  RigidMotion
  RigidMotion::turned(const Tensor<1, 3> &d,
                      const Tensor<1, 3> &turn,
                      const Point<3>     &c)
  {
    RigidMotion motion = translated(d);
    motion.centre      = c;
    // The length of a rotation vector is the angle [rad]; rotation_about()
    // takes degrees.
    if (const double angle = turn.norm(); angle > 0)
      motion.rotation = bodies::rotation_about(turn, angle * 180 / M_PI);
    return motion;
  }
} // namespace conetact::pairing
