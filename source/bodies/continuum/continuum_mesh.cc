// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/continuum_mesh.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

namespace conetact
{
  using dealii::DoFHandler;

  namespace
  {
    /** One dof at each vertex: its number is that of the node. */
    template <class Accessor>
    unsigned int
    node_of(const Accessor &object, const unsigned int vertex)
    {
      return static_cast<unsigned int>(object->vertex_dof_index(vertex, 0));
    }

    template <int dim>
    typename ContinuumMesh<dim>::Face
    boundary_face(const typename DoFHandler<dim>::active_cell_iterator &cell,
                  const unsigned int                                    number)
    {
      const auto                        face = cell->face(number);
      typename ContinuumMesh<dim>::Face result;
      for (const unsigned int v : face->vertex_indices())
        result.nodes[v] = node_of(face, v);
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
        {
          HangingNode node{static_cast<unsigned int>(line.index), {}};
          for (const auto &[dof, weight] : line.entries)
            node.masters.emplace_back(static_cast<unsigned int>(dof), weight);
          hanging.push_back(node);
        }
      return hanging;
    }
  } // namespace

  template <int dim>
  ContinuumMesh<dim>::ContinuumMesh(const dealii::Triangulation<dim> &mesh)
  {
    DoFHandler<dim> dofs(mesh);
    dofs.distribute_dofs(dealii::FE_Q<dim>(1));
    nodes.resize(dofs.n_dofs());
    cells.reserve(mesh.n_active_cells());
    for (const auto &cell : dofs.active_cell_iterators())
      {
        cells.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          {
            cells.back()[v]        = node_of(cell, v);
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
