// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/structures/continuum_mesh.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

namespace conetact
{
  using dealii::DoFHandler;

  namespace
  {
    /** The node of a vertex whose dofs come one after the other. */
    template <int dim, class Accessor>
    unsigned int
    node_of(const Accessor &object, const unsigned int vertex)
    {
      const auto first = object->vertex_dof_index(vertex, 0);
      for (unsigned int c = 0; c < dim; ++c)
        AssertThrow(first % dim == 0 &&
                      object->vertex_dof_index(vertex, c) == first + c,
                    dealii::ExcInternalError());
      return static_cast<unsigned int>(first / dim);
    }

    template <int dim>
    typename ContinuumMesh<dim>::Face
    boundary_face(const typename DoFHandler<dim>::active_cell_iterator &cell,
                  const unsigned int                                    number)
    {
      const auto                        face = cell->face(number);
      typename ContinuumMesh<dim>::Face result;
      for (const unsigned int v : face->vertex_indices())
        result.nodes[v] = node_of<dim>(face, v);
      result.id = face->boundary_id();

      const auto along = [&](const unsigned int v, const unsigned int w) {
        return to_space(face->vertex(w)) - to_space(face->vertex(v));
      };
      const Tensor<1, 3> a = along(0, 1);
      const Tensor<1, 3> normal =
        dim == 2 ? Tensor<1, 3>({a[1], -a[0], 0}) :
                   cross_product_3d(along(0, dim), along(1, dim - 1));
      result.inward =
        normal * (to_space(face->center()) - to_space(cell->center())) < 0;
      return result;
    }

    template <int dim>
    std::vector<HangingNode>
    find_hanging_nodes(const DoFHandler<dim> &dofs)
    {
      dealii::AffineConstraints<double> constraints;
      dealii::DoFTools::make_hanging_node_constraints(dofs, constraints);
      constraints.close(); // masters of masters: none hangs itself

      std::vector<HangingNode> hanging;
      for (const auto &line : constraints.get_lines())
        if (line.index % dim == 0)
          {
            HangingNode node{static_cast<unsigned int>(line.index / dim), {}};
            for (const auto &[dof, weight] : line.entries)
              node.masters.emplace_back(static_cast<unsigned int>(dof / dim),
                                        weight);
            hanging.push_back(node);
          }
      return hanging;
    }
  } // namespace

  template <int dim>
  ContinuumMesh<dim>::ContinuumMesh(const dealii::Triangulation<dim> &mesh)
  {
    const dealii::FESystem<dim> fe(dealii::FE_Q<dim>(1), dim);
    DoFHandler<dim>             dofs(mesh);
    dofs.distribute_dofs(fe);
    nodes.resize(dofs.n_dofs() / dim);
    cells.reserve(mesh.n_active_cells());
    for (const auto &cell : dofs.active_cell_iterators())
      {
        cells.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          {
            cells.back()[v]        = node_of<dim>(cell, v);
            nodes[cells.back()[v]] = cell->vertex(v);
          }
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            faces.push_back(boundary_face<dim>(cell, f));
      }
    if (mesh.has_hanging_nodes())
      hanging = find_hanging_nodes(dofs);
  }

  template struct ContinuumMesh<2>;
  template struct ContinuumMesh<3>;
} // namespace conetact
