// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/spacings.h"

#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/closest_point.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  std::map<unsigned int, double>
  spacings(const bodies::Surface &surface, const bodies::Structure &body)
  {
    std::map<unsigned int, double> result;
    for (const bodies::SurfaceFace &face : surface.faces)
      {
        double longest = 0;
        for_each_edge(bodies::n_corners(body, face),
                      [&](const std::size_t i, const std::size_t j) {
                        longest =
                          std::max(longest,
                                   body.position(face.nodes[i])
                                     .distance(body.position(face.nodes[j])));
                      });
        for (const unsigned int node : face.nodes)
          result[node] = std::max(result[node], longest);
      }
    for (const bodies::SurfaceNode &node :
         surface.nodes) // of frames without faces
      result.insert({node.node, std::sqrt(node.area)});
    return result;
  }
} // namespace conetact::pairing
