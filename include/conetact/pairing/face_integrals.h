// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_face_integrals_h
#define conetact_pairing_face_integrals_h

#include "conetact/pairing/facing_parts.h"

#include <Eigen/Core>

#include <limits>
#include <map>
#include <vector>

namespace conetact::pairing
{
  /** Integrals over the parts of one slave face that see the master, with its
   * shape functions N_k. */
  struct FaceIntegrals
  {
    Eigen::MatrixXd                         linear;  ///< linear_functions()
    Eigen::MatrixXd                         mass;    ///< N_k N_i
    Eigen::VectorXd                         areas;   ///< N_k
    std::map<unsigned int, Eigen::VectorXd> masters; ///< N_k N_l
    /** N_k times outward normals of either side, where it is bent. */
    Eigen::MatrixX3d  slave_normals, master_normals;
    std::vector<bool> facing;   ///< whether its nodes are over the master
    double            part = 0; ///< of the face, that sees it
    double            size = 0;
    double lowest = std::numeric_limits<double>::max(); ///< gap [length]
  };

  /** The plane of a slave face, in which faces are clipped. */
  ProjectionPlane
  plane_of(const FaceNet::Face &face);

  /**
   * Integrates over the segments that a slave face and the master have in
   * common. Points correspond along the normal of the slave face. Round an axis
   * areas are integrals of r ds. Which nodes face the master is left open.
   */
  FaceIntegrals
  integrate(const FaceNet::Face                  &face,
            const std::vector<FacingParts::Part> &parts,
            const std::vector<FaceNet::Face>     &master,
            const bool                            axisymmetric);
} // namespace conetact::pairing

#endif
