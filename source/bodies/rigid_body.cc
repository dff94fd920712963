// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/rigid_body.h"

namespace conetact::bodies
{
  RigidBody::RigidBody(const unsigned int           d,
                       const Point<3>              &reference,
                       const std::vector<Point<3>> &points,
                       const bool                   axisymmetric)
    : dim(d)
    , is_ring(axisymmetric)
    , positions(1, reference)
  {
    positions.insert(positions.end(), points.begin(), points.end());
  }

  std::string
  RigidBody::description() const
  {
    return "rigid, met by " + std::to_string(n_nodes() - 1) + " contact nodes";
  }
} // namespace conetact::bodies
