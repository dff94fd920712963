// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/doubled_nodes.h"

#include "conetact/bodies/face_nodes.h"

#include <algorithm>
#include <limits>

namespace conetact::bodies
{
  namespace
  {
    double
    shortest_edge(const Structure &body, const Surface &surface)
    {
      double shortest = std::numeric_limits<double>::max();
      for (const SurfaceFace &face : surface.faces)
        {
          const std::size_t n = n_corners(body, face);
          for (std::size_t i = 1; i < n; ++i)
            shortest = std::min(shortest,
                                body.position(face.nodes[i])
                                  .distance(body.position(face.nodes[0])));
        }
      return shortest;
    }
  } // namespace

  std::vector<std::pair<unsigned int, unsigned int>>
  doubled_nodes(const Structure &body)
  {
    constexpr double one_place = 1e-6; // of an edge

    std::vector<std::pair<unsigned int, unsigned int>> doubled;
    const Surface surface = body.surface(body.boundary_ids());
    if (surface.two_sided || surface.faces.empty())
      return doubled;
    const double near = one_place * shortest_edge(body, surface);
    // Along a line that no mesh has many nodes across: coordinates alone would
    // put whole faces at one place.
    const Tensor<1, 3> line({1., .6180339887, .4142135624});
    std::vector<std::pair<double, unsigned int>> order;
    for (const SurfaceNode &node : surface.nodes)
      order.emplace_back(line * node.position, node.node);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1;
           j < order.size() &&
           order[j].first - order[i].first <= line.norm() * near;
           ++j)
        if (body.position(order[i].second)
              .distance(body.position(order[j].second)) <= near)
          doubled.emplace_back(order[i].second, order[j].second);
    return doubled;
  }
} // namespace conetact::bodies
