// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_corner_parts_h
#define conetact_pairing_corner_parts_h

#include "conetact/pairing/face_net.h"

#include <Eigen/Core>

namespace conetact::pairing
{
  /** Of a face the functions of the nodes that contacts stand at, rows in terms
   * of its shape functions: these themselves, or linear ones of corners. */
  Eigen::MatrixXd
  linear_functions(const FaceNet::Face &face);

  /** Integrals over a face that contacts stand at the corners of, with the
   * functions of these (corner_functions(), dual_functions.h). */
  struct CornerParts
  {
    Eigen::VectorXd areas;  ///< @f$\int \varphi_j@f$ [length^2]
    Eigen::MatrixXd slaves; ///< @f$\int \varphi_j N_k@f$ [length^2]

    /** Adds those of a corner to its row. */
    template <typename Row>
    void
    add(const FaceNet::Face &face, const std::size_t corner, Row &row) const
    {
      const auto j = static_cast<Eigen::Index>(corner);
      row.area += areas[j];
      for (std::size_t k = 0; k < face.nodes.size(); ++k)
        row.slaves[face.nodes[k]] += slaves(j, static_cast<Eigen::Index>(k));
    }
  };
  CornerParts
  corner_parts(const FaceNet::Face &face);
} // namespace conetact::pairing

#endif
