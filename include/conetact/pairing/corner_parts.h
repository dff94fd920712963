// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_corner_parts_h
#define conetact_pairing_corner_parts_h

#include "conetact/pairing/face_net.h"

#include <Eigen/Core>

namespace conetact::pairing
{
  /** Integrals over a face that contacts stand at the corners of, with the
   * functions @f$\psi_j@f$ of these that are dual to the linear ones. */
  struct CornerParts
  {
    Eigen::VectorXd areas;  ///< @f$\int \psi_j@f$ [length^2]
    Eigen::MatrixXd slaves; ///< @f$\int \psi_j N_k@f$ of all nodes [length^2]
  };
  CornerParts
  corner_parts(const FaceNet::Face &face);
} // namespace conetact::pairing

#endif
