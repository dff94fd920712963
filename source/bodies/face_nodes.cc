// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/face_nodes.h"

namespace conetact::bodies
{
  std::size_t
  n_corners(const Structure &body, const SurfaceFace &face)
  {
    if (face.nodes.size() == 9)
      return 4;
    if (face.nodes.size() == 6)
      return 3;
    // Nodes of continua in the plane have two components.
    if (face.nodes.size() == 3 && body.n_components() == 2)
      return 2;
    return face.nodes.size();
  }

  std::vector<HangingNode>
  middle_nodes(const Structure &body, const SurfaceFace &face)
  {
    using Corners                                 = std::vector<std::size_t>;
    static const std::vector<Corners> of_segment  = {{0, 1}},
                                      of_triangle = {{0, 1}, {1, 2}, {2, 0}},
                                      of_quadrilateral = {{0, 2},
                                                          {1, 3},
                                                          {0, 1},
                                                          {2, 3},
                                                          {0, 1, 2, 3}};
    if (!is_of_second_degree(body, face))
      return {};
    const std::size_t           n   = n_corners(body, face);
    const std::vector<Corners> &all = n == 2 ? of_segment :
                                      n == 3 ? of_triangle :
                                               of_quadrilateral;
    std::vector<HangingNode>    result;
    for (std::size_t m = 0; m < all.size(); ++m)
      {
        result.push_back({face.nodes[n + m], {}});
        for (const std::size_t corner : all[m])
          result.back().masters.emplace_back(
            face.nodes[corner], 1. / static_cast<double>(all[m].size()));
      }
    return result;
  }

  std::vector<std::vector<unsigned int>>
  parts_of_first_degree(const Structure &body, const SurfaceFace &face)
  {
    const auto &n = face.nodes;
    if (!is_of_second_degree(body, face))
      return {n};
    if (n.size() == 3)
      return {{n[0], n[2]}, {n[2], n[1]}};
    if (n.size() == 6)
      return {{n[0], n[3], n[5]},
              {n[3], n[1], n[4]},
              {n[5], n[4], n[2]},
              {n[3], n[4], n[5]}};
    return {{n[0], n[6], n[4], n[8]},
            {n[6], n[1], n[8], n[5]},
            {n[4], n[8], n[2], n[7]},
            {n[8], n[5], n[7], n[3]}};
  }

  std::vector<std::vector<unsigned int>>
  parts_of_contacts(const Structure &body, const SurfaceFace &face)
  {
    if (!face.meets_at_corners)
      return parts_of_first_degree(body, face);
    const auto end =
      face.nodes.begin() + static_cast<std::ptrdiff_t>(n_corners(body, face));
    return {{face.nodes.begin(), end}};
  }
} // namespace conetact::bodies
