// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/obstacles.h"

#include "conetact/bodies/placement.h"

#include <deal.II/base/exceptions.h>

namespace conetact::pairing
{
  Tensor<1, 3>
  Obstacle::displacement_at(const double t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    Tensor<1, 3> d;
    for (unsigned int c = 0; c < displacement.size(); ++c)
      // a translation: the same everywhere
      d[c] = displacement[c](Point<3>(), t);
    return d;
  }

  /* The rotation is about the reference point, which the translation moves.
     What is free has its motion among the unknowns, and none here. */
  RigidMotion
  Obstacle::motion_at(const double t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    if (free.any())
      return {};
    RigidMotion motion = RigidMotion::translated(displacement_at(t));
    if (turn)
      {
        motion.centre = reference;
        motion.rotation =
          bodies::rotation_about(turn_axis, (*turn)(Point<3>(), t));
      }
    return motion;
  }
} // namespace conetact::pairing
