// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_round_surface_h
#define conetact_pairing_round_surface_h

#include "conetact/bodies/structure.h"

#include <optional>

namespace conetact::pairing
{
  /** A circle in the plane, a cylinder or a sphere. */
  struct RoundSurface
  {
    Point<3>     centre;
    Tensor<1, 3> axis; ///< unit; zero: a sphere
    double       radius = 0;

    /** Unit, away from the axis; zero on it. */
    Tensor<1, 3>
    outward(const Point<3> &p) const;
    /** Whether both are round the same axis. */
    bool
    is_about_axis_of(const RoundSurface &other) const;
  };

  /** The one on which all nodes of a surface lie, to the digits of files; none
   * where the surface is another one, has faces of more than 26 degrees, or is
   * too small a part to tell. */
  std::optional<RoundSurface>
  round_surface(const bodies::Structure   &body,
                const bodies::BoundaryIds &ids,
                const unsigned int         dim);
} // namespace conetact::pairing

#endif
