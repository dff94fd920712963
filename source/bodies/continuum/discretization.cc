// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/discretization.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>

namespace conetact::bodies
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    ReferenceCell
    kind_of_cells(const Triangulation<dim> &mesh)
    {
      return mesh.begin_active()->reference_cell();
    }

    template <int dim>
    std::unique_ptr<FiniteElement<dim>>
    linear_element(const Triangulation<dim> &mesh)
    {
      if (mesh.all_reference_cells_are_hyper_cube())
        return std::make_unique<FE_Q<dim>>(1);
      return std::make_unique<FE_SimplexP<dim>>(1);
    }

    /** Three points a direction; lines are the faces of triangles, too. */
    template <int dim>
    Quadrature<dim - 1>
    quadrature_of_faces(const Triangulation<dim> &mesh)
    {
      if (dim == 3 && !mesh.all_reference_cells_are_hyper_cube())
        return QGaussSimplex<dim - 1>(3);
      return QGauss<dim - 1>(3);
    }

    template <class Accessor>
    unsigned int
    node_of(const Accessor    &object,
            const unsigned int vertex,
            const unsigned int dim)
    {
      // Without renumbering deal.II gives the components of a vertex
      // consecutive dofs.
      return static_cast<unsigned int>(object->vertex_dof_index(vertex, 0)) /
             dim;
    }
  } // namespace

  template <int dim>
  Discretization<dim>::Discretization(
    std::unique_ptr<Triangulation<dim>> finished_mesh)
    : triangulation(std::move(finished_mesh))
    , mapping(kind_of_cells(*triangulation)
                .template get_default_linear_mapping<dim>())
    , fe(*linear_element(*triangulation), dim)
    , dof_handler(*triangulation)
    , quadrature(kind_of_cells(*triangulation)
                   .template get_gauss_type_quadrature<dim>(2))
    , face_quadrature(quadrature_of_faces(*triangulation))
  {
    dof_handler.distribute_dofs(fe);
    if (triangulation->has_hanging_nodes())
      DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    constraints.close();
    find_boundary_faces();
  }

  template <int dim>
  void
  Discretization<dim>::find_boundary_faces()
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f); face->at_boundary())
          {
            BoundaryFace result{cell, f, face->boundary_id(), {}, {}};
            for (const unsigned int v : face->vertex_indices())
              {
                result.nodes.push_back(node_of(face, v, dim));
                for (const unsigned int w : cell->vertex_indices())
                  // The face's own order of vertices is not that of its cell.
                  if (node_of(cell, w, dim) == result.nodes.back())
                    result.shapes.push_back(fe.component_to_system_index(0, w));
              }
            boundary_faces.push_back(result);
          }
  }

  template <int dim>
  std::vector<HangingNode>
  Discretization<dim>::hanging_nodes() const
  {
    std::vector<HangingNode> result;
    for (const auto &line : constraints.get_lines())
      if (line.index % dim == 0) // all components of a node hang alike
        {
          HangingNode node{static_cast<unsigned int>(line.index / dim), {}};
          for (const auto &[dof, weight] : line.entries)
            node.masters.emplace_back(static_cast<unsigned int>(dof / dim),
                                      weight);
          result.push_back(node);
        }
    return result;
  }

  template struct Discretization<2>;
  template struct Discretization<3>;
} // namespace conetact::bodies
