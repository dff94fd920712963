// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_matrices.h"

#include "conetact/bodies/continuum/exact_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace conetact::bodies
{
  namespace
  {
    /** Bytes of matrices that belong to one cell only and are kept. */
    constexpr std::size_t room_for_single_cells = 256u << 20;

    /** Congruent cells that are multiplied together; they fit into the cache.
     */
    constexpr unsigned int cells_at_once = 64;

    /** Nodes relative to the first one, and how exactly they are known. */
    template <int dim>
    struct Outline
    {
      std::vector<double> x;
      double              tolerance;
      unsigned int        phase;

      Outline(const std::vector<Point<dim>> &vertices,
              const bool                     is_ring,
              const unsigned int             material)
        : x(dim * (vertices.size() - 1))
        , phase(material)
      {
        double size = 0, distance = 0;
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            x[i]     = vertices[1 + i / dim][i % dim] - vertices[0][i % dim];
            size     = std::max(size, std::abs(x[i]));
            distance = std::max(distance, std::abs(vertices[0][i % dim]));
          }
        // round-off of the coordinates themselves
        tolerance =
          1e-12 * size + 8 * std::numeric_limits<double>::epsilon() * distance;
        if (is_ring) // only those that are moved along the axis are alike
          x.push_back(vertices[0][0]);
      }

      /** A number that is (nearly) equal for congruent cells only. */
      double
      key() const
      {
        double key = 0;
        for (unsigned int i = 0; i < x.size(); ++i)
          // Weights without any relation: other shapes hardly have the same
          // sum.
          key += x[i] * std::cos(1. + 3. * static_cast<double>(i));
        return key * (1 + phase);
      }

      bool
      equals(const Outline &other) const
      {
        for (unsigned int i = 0; i < x.size(); ++i)
          if (!(std::abs(x[i] - other.x[i]) <= tolerance))
            return false;
        return phase == other.phase;
      }
    };
  } // namespace

  template <int dim>
  CellMatrices<dim>::CellMatrices(const ContinuumMesh<dim> &of_mesh,
                                  const Phases<dim>        &materials,
                                  const double              body_thickness)
    : mesh(of_mesh)
    , phases(materials)
    , is_ring(phases.front().element->is_axisymmetric())
    , thickness(body_thickness)
  {
    find_shapes();
    keep_matrices();
  }

  template <int dim>
  void
  CellMatrices<dim>::find_shapes()
  {
    std::vector<Outline<dim>>           known;
    std::multimap<double, unsigned int> by_key;
    shape_of_cell.reserve(mesh.n_cells());
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const Outline<dim> outline(mesh.vertices(cell),
                                   is_ring,
                                   mesh.phase(cell));
        // Most meshes have long runs of one shape.
        unsigned int shape = cell > 0 ? shape_of_cell.back() : 0;
        if (known.empty() || !outline.equals(known[shape]))
          {
            const double key = outline.key();
            // Weights are 1 at most: so much may the keys of equal cells
            // differ.
            const double range = outline.tolerance * (1 + outline.phase) *
                                 static_cast<double>(outline.x.size());
            const auto end = by_key.upper_bound(key + range);
            const auto found =
              std::find_if(by_key.lower_bound(key - range),
                           end,
                           [&](const auto &entry) {
                             return outline.equals(known[entry.second]);
                           });
            shape = found != end ? found->second : n_shapes();
            if (found == end)
              {
                known.push_back(outline);
                shapes.push_back({cell});
                by_key.emplace(key, shape);
              }
          }
        shape_of_cell.push_back(shape);
        ++shapes[shape].n_cells;
      }
  }

  template <int dim>
  void
  CellMatrices<dim>::keep_matrices()
  {
    const std::size_t n_dofs = dim * mesh.n_cell_nodes;
    std::size_t       room =
      room_for_single_cells / (sizeof(double) * n_dofs * n_dofs);
    for (Shape &shape : shapes)
      if (shape.n_cells > 1 || room > 0)
        {
          // Shapes that come again always pay; the others only save a
          // computation for each product.
          room -= shape.n_cells == 1;
          shape.matrix = static_cast<int>(matrices.size());
          matrices.push_back(compute(shape.first_cell));
        }
  }

  template <int dim>
  typename ElementFormulation<dim>::Matrix
  CellMatrices<dim>::compute(const unsigned int cell) const
  {
    typename Element::Matrix k =
      thickness *
      phases[mesh.phase(cell)].element->stiffness(mesh.vertices(cell));
    if (is_ring)
      make_axial_sums_exact(k);
    else
      make_sums_exact(k, dim);
    return k;
  }

  template <int dim>
  void
  CellMatrices<dim>::for_each(const ElementVisitor &visit) const
  {
    std::vector<unsigned int> dofs(dim * mesh.n_cell_nodes);
    typename Element::Matrix  single;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const auto nodes = mesh.cell(cell);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          dofs[i] = dim * nodes[i / dim] + i % dim;
        const int matrix = shapes[shape_of_cell[cell]].matrix;
        if (matrix < 0)
          single = compute(cell);
        visit(dofs,
              matrix < 0 ? single.data() :
                           matrices[static_cast<std::size_t>(matrix)].data());
      }
  }

  template <int dim>
  typename CellMatrices<dim>::Columns
  CellMatrices<dim>::strained(const unsigned int     first,
                              const unsigned int     end,
                              const Eigen::VectorXd &u) const
  {
    Columns result(dim * mesh.n_cell_nodes, end - first);
    for (unsigned int cell = first; cell < end; ++cell)
      {
        const auto nodes = mesh.cell(cell);
        // What the cell moves as a whole has no force, and would cost the
        // digits of what strains it.
        Eigen::Matrix<double, dim, 1> base =
          u.template segment<dim>(dim * nodes[0]);
        if (is_ring)
          base[0] = 0; // to grow is to strain
        for (unsigned int v = 0; v < mesh.n_cell_nodes; ++v)
          result.template block<dim, 1>(dim * v, cell - first) =
            u.template segment<dim>(dim * nodes[v]) - base;
      }
    return result;
  }

  template <int dim>
  void
  CellMatrices<dim>::add_forces(const Eigen::VectorXd &u,
                                Eigen::VectorXd       &f) const
  {
    const unsigned int n_cells = mesh.n_cells();
    Columns            forces;
    for (unsigned int first = 0, end = 0; first < n_cells; first = end)
      {
        const unsigned int shape = shape_of_cell[first];
        const unsigned int limit = std::min(n_cells, first + cells_at_once);
        for (end = first + 1; end < limit && shape_of_cell[end] == shape;)
          ++end;
        const int kept = shapes[shape].matrix;
        forces.noalias() =
          (kept < 0 ? compute(first) :
                      matrices[static_cast<std::size_t>(kept)]) *
          strained(first, end, u);
        for (unsigned int cell = first; cell < end; ++cell)
          for (unsigned int v = 0; v < mesh.n_cell_nodes; ++v)
            f.template segment<dim>(dim * mesh.cell(cell)[v]) +=
              forces.template block<dim, 1>(dim * v, cell - first);
      }
  }

  template class CellMatrices<2>;
  template class CellMatrices<3>;
} // namespace conetact::bodies
