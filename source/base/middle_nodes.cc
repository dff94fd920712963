// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/middle_nodes.h"

#include "conetact/base/cell_topology.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact
{
  namespace
  {
    std::uint64_t
    pair_of(const unsigned int a, const unsigned int b)
    {
      return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    }

    /** The sum of the corners of a cell. */
    Point<3>
    sum_of_corners(const FileMesh &mesh, const FileMesh::Element &cell)
    {
      Point<3> sum;
      for (const unsigned int node : cell.nodes)
        sum += mesh.points[node];
      return sum;
    }
  } // namespace

  MiddleNodes::MiddleNodes(const FileMesh                               &mesh,
                           const std::vector<const FileMesh::Element *> &cells)
    : file(mesh)
  {
    for (const FileMesh::Element *cell : cells)
      if (!cell->middles.empty())
        {
          add_edges(*cell);
          add_quads(*cell);
          if (cell->dim == 3 && cell->nodes.size() == 8)
            add_centre(*cell);
        }
  }

  Point<3>
  MiddleNodes::between(const unsigned int a, const unsigned int b) const
  {
    AssertIndexRange(a, file.points.size());
    AssertIndexRange(b, file.points.size());
    const auto found = places.find(pair_of(a, b));
    if (found != places.end())
      return found->second;
    return Point<3>((file.points[a] + Tensor<1, 3>(file.points[b])) / 2);
  }

  void
  MiddleNodes::add_edges(const FileMesh::Element &cell)
  {
    const auto &edges = topology_of(cell.dim, cell.nodes.size()).edges;
    for (std::size_t e = 0; e < edges.size(); ++e)
      places[pair_of(cell.nodes[edges[e][0]], cell.nodes[edges[e][1]])] =
        file.points[cell.middles[e]];
  }

  /* Of 8 nodes: half the middles less a quarter of the corners. */
  void
  MiddleNodes::add_quads(const FileMesh::Element &cell)
  {
    const CellTopology &kind = topology_of(cell.dim, cell.nodes.size());
    for (std::size_t q = 0; q < kind.quads.size(); ++q)
      {
        unsigned int n[4];
        for (unsigned int i = 0; i < 4; ++i)
          n[i] = cell.nodes[kind.quads[q][i]];
        Point<3> centre;
        if (cell.middles.size() >= kind.edges.size() + kind.quads.size())
          centre = file.points[cell.middles[kind.edges.size() + q]];
        else
          for (unsigned int i = 0; i < 4; ++i)
            centre += between(n[i], n[(i + 1) % 4]) / 2 - file.points[n[i]] / 4;
        places[pair_of(n[0], n[2])] = centre;
        places[pair_of(n[1], n[3])] = centre;
      }
  }

  /* Of 20 nodes: a quarter of the middles less one of the corners. */
  void
  MiddleNodes::add_centre(const FileMesh::Element &cell)
  {
    const CellTopology &kind = topology_of(cell.dim, cell.nodes.size());
    Point<3>            centre;
    if (cell.middles.size() > kind.edges.size() + kind.quads.size())
      centre = file.points[cell.middles.back()];
    else
      {
        centre -= sum_of_corners(file, cell) / 4;
        for (std::size_t e = 0; e < kind.edges.size(); ++e)
          centre += file.points[cell.middles[e]] / 4;
      }
    for (unsigned int i = 0; i < 4; ++i)
      places[pair_of(cell.nodes[i], cell.nodes[(i + 2) % 4 + 4])] = centre;
  }
} // namespace conetact
