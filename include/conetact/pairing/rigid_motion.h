// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_rigid_motion_h
#define conetact_pairing_rigid_motion_h

#include "conetact/base/points.h"

#include <deal.II/base/symmetric_tensor.h>

namespace conetact::pairing
{
  /** The rotation vector of a rotation, its axis times an angle of at most half
   * a turn [rad]. */
  Tensor<1, 3>
  rotation_vector(const Tensor<2, 3> &rotation);

  /**
   * How far a rigid obstacle has moved since the start: turned about a centre
   * c, then translated, @f$x \mapsto c + Q (x - c) + d@f$ [length]. Maps
   * between its own frame, in which its shape is written down, and space; all
   * is exact, and where nothing turns nothing is rounded.
   */
  struct RigidMotion
  {
    Tensor<1, 3> translation;
    Tensor<2, 3> rotation = dealii::unit_symmetric_tensor<3>();
    Point<3>     centre;

    static RigidMotion
    translated(const Tensor<1, 3> &d);
    /** `turn`: rotation vector, the axis times the angle [rad]. */
    static RigidMotion
    turned(const Tensor<1, 3> &d, const Tensor<1, 3> &turn, const Point<3> &c);

    bool
    has_turned() const
    {
      return rotation != Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    }
    /** How far the point of the obstacle that was at p has moved. */
    Tensor<1, 3>
    displacement(const Point<3> &p) const
    {
      return translation + (rotation * (p - centre) - (p - centre));
    }
    /**
     * How far what was at p and moved by u in space has moved in the
     * obstacle's own frame.
     */
    Tensor<1, 3>
    relative(const Point<3> &p, const Tensor<1, 3> &u) const
    {
      const Tensor<2, 3> back = transpose(rotation);
      return back * (u - translation) + (back * (p - centre) - (p - centre));
    }
    Point<3>
    to_space(const Point<3> &own) const
    {
      return own + displacement(own);
    }
    Point<3>
    to_own(const Point<3> &p) const
    {
      return p + relative(p, Tensor<1, 3>());
    }
    Tensor<1, 3>
    direction_to_space(const Tensor<1, 3> &own) const
    {
      return rotation * own;
    }
    /** The rotation vector in space of what has turned by this one in it. */
    Tensor<1, 3>
    turn_to_space(const Tensor<1, 3> &own) const;
    /** The inverse. */
    Tensor<1, 3>
    turn_to_own(const Tensor<1, 3> &turn) const;
    Tensor<1, 3>
    direction_to_own(const Tensor<1, 3> &direction) const
    {
      return transpose(rotation) * direction;
    }
  };
} // namespace conetact::pairing

#endif
