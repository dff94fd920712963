// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/halved_cells.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/geometry_info.h>

#include <cstdint>
#include <unordered_map>

namespace conetact::bodies
{
  namespace
  {
    /** Parts of a cell, and its corners: bit d of their numbers tells on which
     * side they are along axis d. */
    template <int dim>
    constexpr unsigned int n_parts = 1u << dim;

    /** Nodes of the halved mesh, numbered as they are met. */
    template <int dim>
    class HalfwayNodes
    {
    public:
      HalfwayNodes(const ContinuumMesh<dim> &mesh, std::vector<Point<dim>> &n)
        : coarse(mesh)
        , nodes(n)
      {
        numbers.reserve(n_parts<dim> * coarse.nodes.size());
      }
      /** The one in the middle of corners `low` and `high` of a cell, which are
       * opposite on an edge, a face or the cell, or the same. */
      unsigned int
      between(const unsigned int cell,
              const unsigned int low,
              const unsigned int high)
      {
        const auto         corners = coarse.cell(cell);
        const unsigned int across  = low ^ high;
        unsigned int       first   = low; // which has the smallest number
        for (unsigned int c = 0; c < n_parts<dim>; ++c)
          if ((c & ~across) == low && corners[c] < corners[first])
            first = c;
        const auto [place, is_new] =
          numbers.emplace(std::uint64_t{corners[first]} << 32 |
                            corners[first ^ across],
                          static_cast<unsigned int>(nodes.size()));
        if (is_new)
          nodes.push_back(mean(corners, low, across));
        return place->second;
      }

    private:
      Point<dim>
      mean(const dealii::ArrayView<const unsigned int> &corners,
           const unsigned int                           low,
           const unsigned int                           across) const
      {
        Point<dim>   sum;
        unsigned int n = 0;
        for (unsigned int c = 0; c < n_parts<dim>; ++c)
          if ((c & ~across) == low)
            {
              sum += Tensor<1, dim>(coarse.nodes[corners[c]]);
              ++n;
            }
        return sum / n;
      }

      const ContinuumMesh<dim> &coarse;
      std::vector<Point<dim>>  &nodes;
      /** By the two corners. */
      std::unordered_map<std::uint64_t, unsigned int> numbers;
    };
  } // namespace

  template <int dim>
  ContinuumMesh<dim>
  halved(const ContinuumMesh<dim> &mesh)
  {
    constexpr unsigned int n = n_parts<dim>;
    AssertDimension(mesh.n_cell_nodes, n);
    AssertDimension(mesh.hanging.size(), 0);
    ContinuumMesh<dim> fine;
    fine.n_cell_nodes = n;
    fine.nodes_of_cells.reserve(n * mesh.nodes_of_cells.size());
    HalfwayNodes<dim> middle(mesh, fine.nodes);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int part = 0; part < n; ++part)
        {
          fine.material_ids.push_back(mesh.material_ids[cell]);
          if (!mesh.phase_of_cell.empty())
            fine.phase_of_cell.push_back(mesh.phase(cell));
          for (unsigned int corner = 0; corner < n; ++corner)
            fine.nodes_of_cells.push_back(
              middle.between(cell, part & corner, part | corner));
        }
    fine.nodes.shrink_to_fit();
    for (const unsigned int number : mesh.number_of_active)
      for (unsigned int part = 0; part < n; ++part)
        fine.number_of_active.push_back(n * number + part);
    return fine;
  }

  template <int dim>
  std::vector<BoundaryFace>
  halved(const std::vector<BoundaryFace> &faces,
         const ContinuumMesh<dim>        &halved_mesh)
  {
    std::vector<BoundaryFace> parts;
    parts.reserve(n_parts<dim> / 2 * faces.size());
    for (auto first = faces.begin(), end = first; first != faces.end();
         first = end)
      {
        while (end != faces.end() && end->active == first->active)
          ++end;
        for (unsigned int part = 0; part < n_parts<dim>; ++part)
          for (auto face = first; face != end; ++face)
            {
              if ((part >> (face->number / 2) & 1) != face->number % 2)
                continue;
              BoundaryFace of_part = *face;
              of_part.active       = n_parts<dim> * face->active + part;
              const auto nodes =
                halved_mesh.cell(halved_mesh.number(of_part.active));
              for (unsigned int v = 0; v < of_part.nodes.size(); ++v)
                of_part.nodes[v] = nodes[of_part.in_cell[v]];
              parts.push_back(std::move(of_part));
            }
      }
    return parts;
  }

  template ContinuumMesh<2>
  halved(const ContinuumMesh<2> &);
  template ContinuumMesh<3>
  halved(const ContinuumMesh<3> &);
  template std::vector<BoundaryFace>
  halved(const std::vector<BoundaryFace> &, const ContinuumMesh<2> &);
  template std::vector<BoundaryFace>
  halved(const std::vector<BoundaryFace> &, const ContinuumMesh<3> &);
} // namespace conetact::bodies
