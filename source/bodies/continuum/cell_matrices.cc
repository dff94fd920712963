// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_matrices.h"

#include "conetact/bodies/continuum/exact_sums.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::bodies
{
  namespace
  {
    /** Bytes of matrices that belong to one cell each and are kept; of a body
     * that has more, they are not. */
    constexpr std::size_t room_for_single_cells = 256u << 20;
  } // namespace

  template <int dim>
  CellMatrices<dim>::CellMatrices(const ContinuumMesh<dim> &of_mesh,
                                  const Phases<dim>        &materials,
                                  const double              body_thickness)
    : Elements(dim)
    , mesh(of_mesh)
    , phases(materials)
    , is_ring(phases.front().element->is_axisymmetric())
    , thickness(body_thickness)
    , shapes(mesh, is_ring)
  {
    keep_matrices();
  }

  template <int dim>
  void
  CellMatrices<dim>::keep_matrices()
  {
    const std::size_t n_dofs = dim * mesh.n_cell_nodes;
    const auto is_single = [](const auto &shape) { return shape.n_cells == 1; };
    const auto n_single  = static_cast<std::size_t>(
      std::count_if(shapes.all().begin(), shapes.all().end(), is_single));
    // Shapes that come again always pay; the others only save a computation
    // for each product.
    const bool has_room =
      n_single * sizeof(double) * n_dofs * n_dofs <= room_for_single_cells;
    for (const auto &shape : shapes.all())
      {
        const bool is_kept = has_room || !is_single(shape);
        kept.push_back(is_kept ? static_cast<int>(matrices.size()) : -1);
        if (is_kept)
          matrices.push_back(compute(shape.first_cell));
      }
  }

  template <int dim>
  typename CellMatrices<dim>::Matrix
  CellMatrices<dim>::compute(const unsigned int cell) const
  {
    Matrix k = phases[mesh.phase(cell)].element->stiffness(mesh.vertices(cell));
    k *= thickness;
    if (is_ring)
      make_axial_sums_exact(k);
    else
      make_sums_exact(k, dim);
    return k;
  }

  template <int dim>
  const typename CellMatrices<dim>::Matrix *
  CellMatrices<dim>::find_kept(const unsigned int cell) const
  {
    const int place = kept[shapes.of(cell)];
    return place < 0 ? nullptr : &matrices[static_cast<std::size_t>(place)];
  }

  template <int dim>
  bool
  CellMatrices<dim>::has_some(const unsigned int cell,
                              const SomeNodes   *nodes) const
  {
    const auto of_cell = mesh.cell(cell);
    return nodes == nullptr ||
           std::any_of(of_cell.begin(), of_cell.end(), [&](const auto node) {
             return (*nodes)[node];
           });
  }

  template <int dim>
  template <typename Visit>
  void
  CellMatrices<dim>::for_each_cell(const SomeNodes *nodes,
                                   const Visit     &visit) const
  {
    Assert(nodes == nullptr || nodes->size() == mesh.nodes.size(),
           dealii::ExcMessage("Each node is meant, or is not."));
    std::vector<unsigned int> dofs(dim * mesh.n_cell_nodes);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      if (has_some(cell, nodes))
        {
          const auto of_cell = mesh.cell(cell);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            dofs[i] = dim * of_cell[i / dim] + i % dim;
          visit(cell, dofs);
        }
  }

  template <int dim>
  void
  CellMatrices<dim>::for_each_connection(const ConnectionVisitor &visit) const
  {
    for_each_cell(nullptr,
                  [&](const unsigned int, const auto &dofs) { visit(dofs); });
  }

  template <int dim>
  void
  CellMatrices<dim>::for_each_connection_at(
    const SomeNodes         &nodes,
    const ConnectionVisitor &visit) const
  {
    for_each_cell(&nodes,
                  [&](const unsigned int, const auto &dofs) { visit(dofs); });
  }

  template <int dim>
  void
  CellMatrices<dim>::visit_cells(const SomeNodes      *nodes,
                                 const ElementVisitor &visit) const
  {
    Matrix single;
    for_each_cell(nodes,
                  [&](const unsigned int               cell,
                      const std::vector<unsigned int> &dofs) {
                    const Matrix *const matrix = find_kept(cell);
                    if (matrix == nullptr)
                      single = compute(cell);
                    visit(dofs,
                          matrix == nullptr ? single.data() : matrix->data());
                  });
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
  CellMatrices<dim>::add_forces_of_run(const unsigned int     first,
                                       const unsigned int     end,
                                       const Eigen::VectorXd &u,
                                       Columns               &forces,
                                       Eigen::VectorXd       &f) const
  {
    const Matrix *const matrix = find_kept(first);
    forces.noalias() =
      (matrix == nullptr ? compute(first) : *matrix) * strained(first, end, u);
    for (unsigned int cell = first; cell < end; ++cell)
      for (unsigned int v = 0; v < mesh.n_cell_nodes; ++v)
        f.template segment<dim>(dim * mesh.cell(cell)[v]) +=
          forces.template block<dim, 1>(dim * v, cell - first);
  }

  template <int dim>
  std::size_t
  CellMatrices<dim>::multiply_cells(const SomeNodes       *nodes,
                                    const Eigen::VectorXd &u,
                                    Eigen::VectorXd       &f) const
  {
    Columns     forces;
    std::size_t n = 0;
    shapes.for_each_run([&](const unsigned int first, const unsigned int end) {
      for (unsigned int begin = first, to = first; begin < end; begin = to)
        {
          const bool is_meant = has_some(begin, nodes);
          for (to = begin + 1; to < end && has_some(to, nodes) == is_meant;)
            ++to;
          if (!is_meant)
            continue;
          add_forces_of_run(begin, to, u, forces, f);
          n += to - begin;
        }
    });
    return n;
  }

  template <int dim>
  double
  CellMatrices<dim>::largest_stretch(const Eigen::VectorXd &u) const
  {
    double largest = 0; // square, until the end
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto                          cell = mesh.cell(c);
        const Eigen::Matrix<double, dim, 1> base =
          u.template segment<dim>(dim * cell[0]);
        for (unsigned int v = 1; v < mesh.n_cell_nodes; ++v)
          largest = std::max(
            largest,
            (u.template segment<dim>(dim * cell[v]) - base).squaredNorm());
      }
    return std::sqrt(largest);
  }

  template class CellMatrices<2>;
  template class CellMatrices<3>;
} // namespace conetact::bodies
