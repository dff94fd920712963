// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/corner_parts.h"

#include "conetact/pairing/dual_functions.h"
#include "conetact/pairing/projected_face.h"

#include <numeric>

namespace conetact::pairing
{
  CornerParts
  corner_parts(const FaceNet::Face &face)
  {
    using Eigen::Index;
    const ProjectionPlane plane(face.centre,
                                face.outward,
                                face.corners.size() == 2);
    const ProjectedFace   own(face, plane);
    const auto            n     = static_cast<Index>(face.n_functions);
    const auto            nodes = static_cast<Index>(face.nodes.size());
    CornerParts           parts{Eigen::VectorXd::Zero(n),
                      Eigen::MatrixXd::Zero(n, nodes)};
    Eigen::MatrixXd       mass = Eigen::MatrixXd::Zero(n, n);
    for (const PlanePoint &q :
         gauss_points(own.outline(), own.skewness() == 0 ? 0 : 1))
      {
        const ProjectedFace::Seen seen     = own.at(q.position);
        const Eigen::VectorXd     linear   = seen.shape.head(n);
        const Eigen::VectorXd     weighted = q.weight * seen.stretch * linear;
        parts.areas += weighted;
        parts.slaves += weighted * nodal_shapes(face, seen).transpose();
        mass += weighted * linear.transpose();
      }
    std::vector<Index> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), Index{0});
    const Eigen::MatrixXd dual = dual_functions(mass, parts.areas, all);
    return {dual * parts.areas, dual * parts.slaves};
  }
} // namespace conetact::pairing
