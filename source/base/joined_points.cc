// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/joined_points.h"

#include "conetact/base/cell_topology.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace conetact
{
  namespace
  {
    /** The longest edge of the smallest cell. */
    double
    smallest_size(const FileMesh &mesh)
    {
      double smallest = std::numeric_limits<double>::max();
      for (const FileMesh::Element &element : mesh.elements)
        {
          double longest = 0;
          for (const auto &edge :
               topology_of(element.dim, element.nodes.size()).edges)
            longest = std::max(longest,
                               mesh.points[element.nodes[edge[0]]].distance(
                                 mesh.points[element.nodes[edge[1]]]));
          if (longest > 0)
            smallest = std::min(smallest, longest);
        }
      return smallest;
    }

    /** Each point, or the first one at its place. */
    std::vector<unsigned int>
    first_at_place(const std::vector<Point<3>> &points, const double near)
    {
      // Along a line that no mesh has many nodes across.
      const Tensor<1, 3>        line({1., .6180339887, .4142135624});
      std::vector<unsigned int> order(points.size()), first(points.size());
      std::iota(order.begin(), order.end(), 0u);
      first                        = order;
      const std::vector<double> at = [&] {
        std::vector<double> result;
        for (const Point<3> &p : points)
          result.push_back(line * p);
        return result;
      }();
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
        return at[a] < at[b] || (at[a] == at[b] && a < b);
      });
      for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1;
             j < order.size() &&
             at[order[j]] - at[order[i]] <= line.norm() * near;
             ++j)
          if (points[order[i]].distance(points[order[j]]) <= near)
            {
              const unsigned int low =
                std::min(first[order[i]], first[order[j]]);
              first[order[i]] = first[order[j]] = low;
            }
      for (unsigned int &p : first)
        while (first[p] != p)
          p = first[p];
      return first;
    }
  } // namespace

  std::size_t
  join_points(FileMesh &mesh, const double part)
  {
    const auto first = first_at_place(mesh.points, part * smallest_size(mesh));
    for (FileMesh::Element &element : mesh.elements)
      for (auto *list : {&element.nodes, &element.middles})
        for (unsigned int &node : *list)
          node = first[node];
    std::size_t n = 0;
    for (unsigned int i = 0; i < first.size(); ++i)
      n += first[i] != i;
    return n;
  }
} // namespace conetact
