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

  const std::vector<MiddleNode> &
  middle_nodes(const unsigned int dim, const std::size_t n_nodes)
  {
    static const std::vector<MiddleNode> none,
      of_line          = {{2, {0, 1}}},
      of_triangle      = {{3, {0, 1}}, {4, {1, 2}}, {5, {2, 0}}},
      of_quadrilateral = {
        {4, {0, 2}}, {5, {1, 3}}, {6, {0, 1}}, {7, {2, 3}}, {8, {0, 1, 2, 3}}};
    if (n_nodes == 9)
      return of_quadrilateral;
    if (n_nodes == 6)
      return of_triangle;
    return dim == 2 && n_nodes == 3 ? of_line : none;
  }

  std::vector<HangingNode>
  middle_nodes(const Structure &body, const SurfaceFace &face)
  {
    std::vector<HangingNode> result;
    for (const MiddleNode &middle :
         middle_nodes(body.n_components(), face.nodes.size()))
      {
        result.push_back({face.nodes[middle.node], {}});
        for (const std::size_t corner : middle.corners)
          result.back().masters.emplace_back(face.nodes[corner],
                                             1. / static_cast<double>(
                                                    middle.corners.size()));
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
