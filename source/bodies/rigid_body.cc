// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/rigid_body.h"

#include <algorithm>

namespace conetact::bodies
{
  RigidBody::RigidBody(const unsigned int           d,
                       const Point<3>              &reference,
                       const std::vector<Point<3>> &points,
                       const bool                   axisymmetric)
    : dim(d)
    , is_ring(axisymmetric)
    , positions(1, reference)
    , n_points(points.size())
  {
    positions.insert(positions.end(), points.begin(), points.end());
  }

  void
  RigidBody::span()
  {
    double reach = 0;
    for (const Point<3> &p : positions)
      reach = std::max(reach, p.distance(positions[0]));
    for (unsigned int d = 0; d < dim; ++d)
      {
        positions.push_back(positions[0]);
        positions.back()[d] += reach > 0 ? reach : 1.;
      }
  }

  std::vector<std::pair<unsigned int, double>>
  RigidBody::weights_of(const Point<3> &p) const
  {
    std::vector<std::pair<unsigned int, double>> weights = {{0, 1.}};
    for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int node = spanning_node(d);
        const double       part =
          (p[d] - positions[0][d]) / (positions[node][d] - positions[0][d]);
        weights.emplace_back(node, part);
        weights[0].second -= part;
      }
    return weights;
  }

  std::string
  RigidBody::description() const
  {
    return "rigid, met by " + std::to_string(n_points) + " contact nodes";
  }
} // namespace conetact::bodies
