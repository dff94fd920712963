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
    scalar_element(const Triangulation<dim> &mesh, const unsigned int degree)
    {
      if (mesh.all_reference_cells_are_hyper_cube())
        return std::make_unique<FE_Q<dim>>(degree);
      return std::make_unique<FE_SimplexP<dim>>(degree);
    }
  } // namespace

  template <int dim>
  Discretization<dim>::Discretization(
    std::unique_ptr<Triangulation<dim>> finished_mesh,
    const unsigned int                  degree,
    const CellNodes<dim>               &nodes)
    : triangulation(std::move(finished_mesh))
    , mapping(kind_of_cells(*triangulation)
                .template get_default_linear_mapping<dim>())
    , fe(*scalar_element(*triangulation, degree), dim)
    , dof_handler(*triangulation)
    , quadrature(kind_of_cells(*triangulation)
                   .template get_gauss_type_quadrature<dim>(degree + 1))
    , given(degree > 1 ? nodes : CellNodes<dim>())
  {
    const bool hangs = triangulation->has_hanging_nodes();
    if (degree == 1 && !hangs)
      number_vertices();
    else
      dof_handler.distribute_dofs(fe);
    if (hangs)
      DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    constraints.close();
  }

  /* As cells meet them, which is deal.II's order. */
  template <int dim>
  void
  Discretization<dim>::number_vertices()
  {
    node_of_vertex.resize(triangulation->n_vertices(),
                          numbers::invalid_unsigned_int);
    for (const auto &cell : triangulation->active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        if (unsigned int &node = node_of_vertex[cell->vertex_index(v)];
            node == numbers::invalid_unsigned_int)
          node = n_vertices++;
  }

  template <int dim>
  typename DoFHandler<dim>::active_cell_iterator
  Discretization<dim>::with_dofs(const CellIterator &cell) const
  {
    return {triangulation.get(), cell->level(), cell->index(), &dof_handler};
  }

  template <int dim>
  unsigned int
  Discretization<dim>::n_nodes() const
  {
    return node_of_vertex.empty() ?
             static_cast<unsigned int>(dof_handler.n_dofs()) / dim :
             n_vertices;
  }

  template <int dim>
  std::vector<unsigned int>
  Discretization<dim>::nodes_of(const CellIterator &cell) const
  {
    std::vector<unsigned int> nodes;
    if (!node_of_vertex.empty())
      {
        for (const unsigned int v : cell->vertex_indices())
          nodes.push_back(node_of_vertex[cell->vertex_index(v)]);
        return nodes;
      }
    // Without renumbering deal.II gives the components of a node consecutive
    // dofs.
    std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
    with_dofs(cell)->get_dof_indices(dofs);
    for (unsigned int v = 0; v < fe.dofs_per_cell / dim; ++v)
      nodes.push_back(static_cast<unsigned int>(
        dofs[fe.component_to_system_index(0, v)] / dim));
    return nodes;
  }

  template <int dim>
  std::vector<unsigned int>
  Discretization<dim>::nodes_of_face(const CellIterator &cell,
                                     const unsigned int  face) const
  {
    std::vector<unsigned int> nodes;
    if (!node_of_vertex.empty())
      {
        for (const unsigned int v : cell->face(face)->vertex_indices())
          nodes.push_back(node_of_vertex[cell->face(face)->vertex_index(v)]);
        return nodes;
      }
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_face(face));
    const auto                           of_dofs = with_dofs(cell);
    of_dofs->face(face)->get_dof_indices(dofs, of_dofs->active_fe_index());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (fe.face_system_to_component_index(i, face).first == 0)
        nodes.push_back(static_cast<unsigned int>(dofs[i] / dim));
    return nodes;
  }

  template <int dim>
  std::vector<Point<dim>>
  Discretization<dim>::places_of(const CellIterator &cell) const
  {
    if (!given.empty())
      return given.of_cell({&*triangulation, cell->level(), cell->index()});
    std::vector<Point<dim>> places;
    for (const unsigned int v : cell->vertex_indices())
      places.push_back(cell->vertex(v));
    for (unsigned int v = cell->n_vertices(); v < fe.dofs_per_cell / dim; ++v)
      places.push_back(mapping.transform_unit_to_real_cell(
        cell,
        fe.get_unit_support_points()[fe.component_to_system_index(0, v)]));
    return places;
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
