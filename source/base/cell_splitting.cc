// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/cell_splitting.h"

#include "conetact/base/cell_topology.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  namespace
  {
    using Corners = std::vector<unsigned int>;

    bool
    is_collapsed(const Corners &nodes)
    {
      return std::set<unsigned int>(nodes.begin(), nodes.end()).size() <
             nodes.size();
    }

    bool
    is_simplex(const FileMesh::Element &element)
    {
      return element.nodes.size() == element.dim + 1;
    }

    /** Two triangles with the diagonal through the smallest number; one where
     * two corners are the same. */
    std::vector<Corners>
    split_quadrilateral(Corners nodes)
    {
      std::rotate(nodes.begin(),
                  std::min_element(nodes.begin(), nodes.end()),
                  nodes.end());
      std::vector<Corners> triangles;
      for (const Corners &triangle : {Corners{nodes[0], nodes[1], nodes[2]},
                                      Corners{nodes[0], nodes[2], nodes[3]}})
        if (!is_collapsed(triangle))
          triangles.push_back(triangle);
      return triangles;
    }

    /** The faces of a cell as triangles, which look outward. */
    std::vector<Corners>
    triangles_round(const FileMesh::Element &cell)
    {
      const CellTopology  &kind = topology_of(cell.dim, cell.nodes.size());
      std::vector<Corners> result;
      const auto           corners = [&](const Corners &local) {
        Corners global;
        for (const unsigned int i : local)
          global.push_back(cell.nodes[i]);
        return global;
      };
      for (const Corners &quad : kind.quads)
        for (const Corners &triangle : split_quadrilateral(corners(quad)))
          result.push_back(triangle);
      for (const Corners &triangle : kind.triangles)
        if (!is_collapsed(corners(triangle)))
          result.push_back(corners(triangle));
      return result;
    }

    /** Of the first corners of a piece, as long as its area. */
    Tensor<1, 3>
    normal_of(const FileMesh &mesh, const Corners &n)
    {
      const Point<3> &p = mesh.points[n[0]];
      return cross_product_3d(mesh.points[n[1]] - p, mesh.points[n[2]] - p);
    }

    /** Of a tetrahedron; of a triangle its part along `normal`. */
    double
    measure(const FileMesh &mesh, const Corners &n, const Tensor<1, 3> &normal)
    {
      const Tensor<1, 3> area = normal_of(mesh, n);
      return area *
             (n.size() == 3 ? normal : mesh.points[n[3]] - mesh.points[n[0]]);
    }

    /** From the smallest corner to each triangle that does not have it; faces
     * that have it are divided by a diagonal through it. */
    std::vector<Corners>
    split_cell(const FileMesh::Element &cell)
    {
      const unsigned int top =
        *std::min_element(cell.nodes.begin(), cell.nodes.end());
      std::vector<Corners> tetrahedra;
      for (const Corners &face : triangles_round(cell))
        if (std::find(face.begin(), face.end(), top) == face.end())
          tetrahedra.push_back({face[0], face[2], face[1], top});
      return tetrahedra;
    }

    /** All pieces must have the same orientation. */
    void
    refuse_folded(const FileMesh             &mesh,
                  const FileMesh::Element    &cell,
                  const std::vector<Corners> &pieces)
    {
      double             least = 0, largest = 0;
      const Tensor<1, 3> normal =
        pieces.empty() ? Tensor<1, 3>() : normal_of(mesh, pieces[0]);
      for (const Corners &piece : pieces)
        {
          const double v = measure(mesh, piece, normal);
          least          = std::min(least, v);
          largest        = std::max(largest, v);
        }
      if (pieces.empty() ||
          std::min(-least, largest) > 1e-9 * std::max(-least, largest))
        throw FileFault{"the cell with a corner at " +
                        to_text(mesh.points[cell.nodes[0]]) +
                        " is folded or flat: its sides cut each other"};
    }

    std::string
    name_of(const FileMesh::Element &element)
    {
      if (is_collapsed(element.nodes))
        return "cells with corners in one node";
      static const std::map<std::pair<unsigned int, std::size_t>, std::string>
        names = {{{2, 3}, "triangles"},
                 {{2, 4}, "quadrilaterals"},
                 {{3, 4}, "tetrahedra"},
                 {{3, 5}, "pyramids"},
                 {{3, 6}, "wedges"},
                 {{3, 8}, "hexahedra"}};
      return names.at({element.dim, element.nodes.size()});
    }
  } // namespace

  bool
  are_mixed(const std::vector<const FileMesh::Element *> &cells)
  {
    std::size_t n_simplices = 0;
    for (const FileMesh::Element *cell : cells)
      {
        n_simplices += is_simplex(*cell);
        const std::size_t n = cell->nodes.size();
        if ((!is_simplex(*cell) && n != (cell->dim == 2 ? 4 : 8)) ||
            is_collapsed(cell->nodes))
          return true;
      }
    return n_simplices > 0 && n_simplices < cells.size();
  }

  std::string
  count_of_kinds(const std::vector<const FileMesh::Element *> &cells)
  {
    std::map<std::string, std::size_t> counts;
    for (const FileMesh::Element *cell : cells)
      ++counts[name_of(*cell)];
    std::vector<std::string> parts;
    for (const auto &[name, n] : counts)
      parts.push_back(std::to_string(n) + " " + name);
    return join(parts);
  }

  std::vector<FileMesh::Element>
  split_into_simplices(const FileMesh                               &mesh,
                       const std::vector<const FileMesh::Element *> &elements,
                       const bool                                    joined)
  {
    std::vector<FileMesh::Element> result;
    for (const FileMesh::Element *element : elements)
      {
        if (is_simplex(*element) && is_collapsed(element->nodes))
          {
            if (!joined)
              throw FileFault{"the cell with a corner at " +
                              to_text(mesh.points[element->nodes[0]]) +
                              " has a node twice: nothing is left of it, and "
                              "its neighbours do not meet. Mesh it again"};
            continue;
          }
        std::vector<Corners> pieces = {element->nodes};
        if (element->dim == 2 && !is_simplex(*element))
          pieces = split_quadrilateral(element->nodes);
        else if (element->dim == 3 && !is_simplex(*element))
          pieces = split_cell(*element);
        if (!is_simplex(*element))
          refuse_folded(mesh, *element, pieces);
        for (Corners &piece : pieces)
          result.push_back({element->dim, std::move(piece), element->groups});
      }
    return result;
  }
} // namespace conetact
