// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtk_middles.h"

#include "conetact/base/cell_topology.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace conetact
{
  namespace
  {
    /** The corners that a middle node is between. */
    using Between = std::vector<unsigned int>;

    /** In Gmsh's order: of edges, of faces with four corners, of the cell. */
    std::vector<Between>
    places_of_middles(const FileMesh::Element &cell)
    {
      const CellTopology  &kind   = topology_of(cell.dim, cell.nodes.size());
      std::vector<Between> places = kind.edges;
      places.insert(places.end(), kind.quads.begin(), kind.quads.end());
      places.emplace_back(cell.nodes.size());
      std::iota(places.back().begin(), places.back().end(), 0u);
      return places;
    }

    Point<3>
    mean(const FileMesh          &mesh,
         const FileMesh::Element &cell,
         const Between           &corners)
    {
      Point<3> sum;
      for (const unsigned int c : corners)
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
        if (cell.dim != 3 || cell.middles.empty())
          continue;
        const std::vector<Between> places = places_of_middles(cell);
        if (cell.middles.size() > places.size())
          continue;
        std::vector<unsigned int> middles = arranged(mesh, cell, places);
        // Where edges are bent so much that one is the nearest twice, the
        // order stays.
        if (std::set<unsigned int>(middles.begin(), middles.end()).size() ==
            middles.size())
          cell.middles = std::move(middles);
      }
  }
} // namespace conetact
