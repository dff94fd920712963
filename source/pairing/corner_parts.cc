// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/corner_parts.h"

#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/dual_functions.h"
#include "conetact/pairing/projected_face.h"

namespace conetact::pairing
{
  using Eigen::Index;

  Eigen::MatrixXd
  linear_functions(const FaceNet::Face &face)
  {
    const auto      n      = static_cast<Index>(face.n_functions);
    const auto      nodes  = static_cast<Index>(face.nodes.size());
    Eigen::MatrixXd linear = Eigen::MatrixXd::Identity(n, nodes);
    if (n < nodes)
      for (const bodies::MiddleNode &middle :
           bodies::middle_nodes(face.corners.size() == 2 ? 2 : 3,
                                face.nodes.size()))
        for (const std::size_t corner : middle.corners)
          // The linear function of a corner has this value at a middle node.
          linear(static_cast<Index>(corner), static_cast<Index>(middle.node)) =
            1. / static_cast<double>(middle.corners.size());
    return linear;
  }

  /**
   * Integrates over the whole face, seen along its mean normal, with dA =
   * stretch times that of the plane: int lambda_j N_k by quadrature, from which
   * int phi_j N_k follows by duality. The mass of the N_k is not needed.
   */
  CornerParts
  corner_parts(const FaceNet::Face &face)
  {
    const ProjectionPlane plane(face.centre,
                                face.outward,
                                face.corners.size() == 2);
    const ProjectedFace   own(face, plane);
    // Products lambda_j N_k have degree 3 on triangles, and up to 6 in the
    // plane of a quadrilateral, more than level 0 takes.
    const unsigned int    level  = face.corners.size() == 4 ? 1 : 0;
    const Eigen::MatrixXd linear = linear_functions(face);
    Eigen::MatrixXd       of_linear =
      Eigen::MatrixXd::Zero(linear.rows(), linear.cols());
    for (const PlanePoint &q : gauss_points(own.outline(), level))
      {
        const ProjectedFace::Seen seen = own.at(q.position);
        of_linear += q.weight * seen.stretch * seen.shape.head(linear.rows()) *
                     nodal_shapes(face, seen).transpose();
      }
    return {of_linear.rowwise().sum(), corner_integrals(of_linear, linear)};
  }
} // namespace conetact::pairing
