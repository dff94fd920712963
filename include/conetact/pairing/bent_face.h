// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_bent_face_h
#define conetact_pairing_bent_face_h

#include "conetact/pairing/face_net.h"

#include <array>
#include <optional>

namespace conetact::pairing
{
  /** A point of a face that may be bent. */
  struct BentPoint
  {
    std::array<double, 2> at; ///< in the unit square or triangle
    Point<3>              point;
    Tensor<1, 3>          normal; ///< unit, outward
  };

  /**
   * The point of a bent face from which p lies along its normal: that of
   * Newton's method from a point near it. It may be a little beyond the edges,
   * where faces are continued; none if it is further off, or is not found.
   */
  std::optional<BentPoint>
  foot_on_bent(const FaceNet::Face         &face,
               const Point<3>              &p,
               const std::array<double, 2> &near);
} // namespace conetact::pairing

#endif
