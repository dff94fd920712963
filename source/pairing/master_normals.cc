// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/master_normals.h"

#include <deal.II/base/exceptions.h>

namespace conetact::pairing
{
  Tensor<1, 3>
  normal_between(const Tensor<1, 3> &outward, const Tensor<1, 3> &of_master)
  {
    Assert(std::abs(outward.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    constexpr double opposite = .5; // cosine: beyond, they do not face
    // Where both sides look the same way, as around the rim of a master, its
    // normal says nothing: that of the slave counts alone.
    if (of_master * outward > -opposite * of_master.norm() ||
        of_master.norm() == 0)
      return -outward;
    // The normal points from the master to the slave, half way between that out
    // of the master and that into the slave.
    const Tensor<1, 3> n = of_master / of_master.norm() - outward;
    return n / n.norm();
  }

  MasterNormals::MasterNormals(const bodies::Surface &master)
  {
    for (const bodies::SurfaceNode &node : master.nodes)
      normals[node.node] = node.normals;
  }

  Tensor<1, 3>
  MasterNormals::between(
    const Tensor<1, 3>                                 &outward,
    const std::vector<std::pair<unsigned int, double>> &masters) const
  {
    Tensor<1, 3> sum;
    for (const auto &[node, weight] : masters)
      if (const auto found = normals.find(node); found != normals.end())
        {
          const Tensor<1, 3> *nearest = nullptr; // of the sides of an edge
          for (const Tensor<1, 3> &n : found->second)
            if (nearest == nullptr || n * outward < *nearest * outward)
              nearest = &n;
          if (nearest != nullptr)
            sum += weight * *nearest;
        }
    return normal_between(outward, sum);
  }
} // namespace conetact::pairing
