// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtk_middles.h"

#include <algorithm>
#include <map>
#include <set>

namespace conetact
{
  namespace
  {
    /** The corners that a middle node is between. */
    using Between = std::vector<std::size_t>;

    /** Of cells with so many corners, in Gmsh's order: edges, then the faces
     * with four corners, and the cell. */
    const std::map<std::size_t, std::vector<Between>> &
    places_of_middles()
    {
      static const std::map<std::size_t, std::vector<Between>> all = {
        {5,
         {{0, 1},
          {0, 3},
          {0, 4},
          {1, 2},
          {1, 4},
          {2, 3},
          {2, 4},
          {3, 4},
          {0, 1, 2, 3}}},
        {6,
         {{0, 1},
          {0, 2},
          {0, 3},
          {1, 2},
          {1, 4},
          {2, 5},
          {3, 4},
          {3, 5},
          {4, 5},
          {0, 1, 3, 4},
          {0, 2, 3, 5},
          {1, 2, 4, 5}}},
        {8,
         {{0, 1},
          {0, 3},
          {0, 4},
          {1, 2},
          {1, 5},
          {2, 3},
          {2, 6},
          {3, 7},
          {4, 5},
          {4, 7},
          {5, 6},
          {6, 7},
          {0, 1, 2, 3},
          {0, 1, 4, 5},
          {0, 3, 4, 7},
          {1, 2, 5, 6},
          {2, 3, 6, 7},
          {4, 5, 6, 7},
          {0, 1, 2, 3, 4, 5, 6, 7}}}};
      return all;
    }

    Point<3>
    mean(const FileMesh          &mesh,
         const FileMesh::Element &cell,
         const Between           &corners)
    {
      Point<3> sum;
      for (const std::size_t c : corners)
        sum += mesh.points[cell.nodes[c]] / static_cast<double>(corners.size());
      return sum;
    }

    /** The middle that is nearest to each place. */
    std::vector<unsigned int>
    arranged(const FileMesh             &mesh,
             const FileMesh::Element    &cell,
             const std::vector<Between> &places)
    {
      std::vector<unsigned int> result;
      for (std::size_t i = 0; i < cell.middles.size(); ++i)
        {
          const Point<3> place = mean(mesh, cell, places[i]);
          result.push_back(
            *std::min_element(cell.middles.begin(),
                              cell.middles.end(),
                              [&](const unsigned int a, const unsigned int b) {
                                return mesh.points[a].distance(place) <
                                       mesh.points[b].distance(place);
                              }));
        }
      return result;
    }
  } // namespace

  void
  arrange_middles_of_vtk(FileMesh &mesh)
  {
    for (FileMesh::Element &cell : mesh.elements)
      {
        const auto found = places_of_middles().find(cell.nodes.size());
        if (cell.dim != 3 || found == places_of_middles().end() ||
            cell.middles.size() > found->second.size())
          continue;
        std::vector<unsigned int> middles = arranged(mesh, cell, found->second);
        // Where edges are bent so much that one is the nearest twice, the
        // order stays.
        if (std::set<unsigned int>(middles.begin(), middles.end()).size() ==
            middles.size())
          cell.middles = std::move(middles);
      }
  }
} // namespace conetact
