// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/master_normals.h"

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace conetact::pairing
{
  MasterNormals::MasterNormals(const bodies::Surface            &master,
                               const std::vector<FaceNet::Face> &slave_faces,
                               const std::vector<FaceNet::Face> &master_faces,
                               const double                      sharp_edge)
    : slave_edges(slave_faces, std::cos(sharp_edge))
    , master_edges(master_faces, std::cos(sharp_edge))
  {
    for (const bodies::SurfaceNode &node : master.nodes)
      normals[node.node] = node.normals;
  }

  Tensor<1, 3>
  MasterNormals::mean(
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
    return sum;
  }

  Tensor<1, 3>
  MasterNormals::between(
    const unsigned int                                  node,
    const Tensor<1, 3>                                 &outward,
    const std::vector<std::pair<unsigned int, double>> &masters,
    const Tensor<1, 3>                                 &of_bent) const
  {
    Assert(std::abs(outward.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    constexpr double   opposite = .5; // cosine: beyond, they do not face
    const Tensor<1, 3> of_master =
      of_bent.norm() > 0 ? of_bent : mean(outward, masters);
    // Where both sides look the same way, as around the rim of a master, its
    // normal says nothing: that of the slave counts alone.
    if (of_master * outward > -opposite * of_master.norm() ||
        of_master.norm() == 0)
      return -outward;
    // The normal points from the master to the slave, between that out of the
    // master and that into the slave.
    const double part = part_of_normal(
      {slave_edges.at(node), slave_edges.curvature({{node, 1.}})},
      {master_edges.at(masters), master_edges.curvature(masters)});
    const Tensor<1, 3> n =
      (1 - part) * of_master / of_master.norm() - part * outward;
    return n / n.norm();
  }
} // namespace conetact::pairing
