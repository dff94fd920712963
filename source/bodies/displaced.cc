// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/displaced.h"

#include "conetact/bodies/face_nodes.h"

#include <map>

namespace conetact::bodies
{
  namespace
  {
    /** Area times normal of a face, on the side of the unit vector `side`. */
    Tensor<1, 3>
    area_vector(const Structure &body, const SurfaceFace &face)
    {
      const auto from_to = [&](const std::size_t i, const std::size_t j) {
        return body.position(face.nodes[j]) - body.position(face.nodes[i]);
      };
      const std::size_t n = n_corners(body, face);
      if (n == 2)
        {
          Tensor<1, 3> e_z;
          e_z[2] = 1;
          return cross_product_3d(from_to(0, 1), e_z);
        }
      if (n == 3)
        return .5 * cross_product_3d(from_to(0, 1), from_to(0, 2));
      // the diagonals of a quadrilateral
      return .5 * cross_product_3d(from_to(0, 3), from_to(1, 2));
    }
  } // namespace

  Surface
  Displaced::surface(const BoundaryIds &ids) const
  {
    Surface result = body.surface(ids);
    std::map<unsigned int, std::vector<Tensor<1, 3>>> around;
    for (SurfaceFace &face : result.faces)
      {
        // The side that was outside stays so, however far bodies turn.
        const double sign = area_vector(body, face) * face.normal < 0 ? -1 : 1;
        const Tensor<1, 3> a = sign * area_vector(*this, face);
        face.normal          = a / a.norm();
        for (const unsigned int node : face.nodes)
          around[node].push_back(a);
      }
    for (SurfaceNode &node : result.nodes)
      {
        node.position = position(node.node);
        if (around[node.node].empty())
          continue; // of a frame without faces
        node.normals = smooth_patches(around[node.node]);
        Tensor<1, 3> sum;
        for (const Tensor<1, 3> &a : around[node.node])
          sum += a;
        if (sum.norm() > 1e-12 * around[node.node][0].norm())
          node.normal = sum / sum.norm();
      }
    return result;
  }
} // namespace conetact::bodies
