// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_nodes.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <map>
#include <memory>

namespace conetact::bodies
{
  using dealii::Point;
  using dealii::Triangulation;

  namespace
  {
    template <int dim>
    using CellOf = typename Triangulation<dim>::cell_iterator;

    template <int dim>
    const dealii::FiniteElement<dim> &
    second_order(const dealii::ReferenceCell &kind)
    {
      static const dealii::FE_Q<dim>        cubes(2);
      static const dealii::FE_SimplexP<dim> simplices(2);
      if (kind.is_simplex())
        return simplices;
      return cubes;
    }

    /** By the numbers of the vertices of a refined cell and of its children,
     * except for the vertex inside a hypercube. */
    template <int dim>
    std::map<unsigned int, Point<dim>>
    unit_places(const CellOf<dim> &cell)
    {
      std::map<unsigned int, Point<dim>> places;
      const auto                         kind = cell->reference_cell();
      const auto                         mean = [&](const auto &object) {
        Point<dim> sum;
        for (const unsigned int v : object->vertex_indices())
          sum += places.at(object->vertex_index(v)) / object->n_vertices();
        return sum;
      };
      for (const unsigned int v : cell->vertex_indices())
        places[cell->vertex_index(v)] = kind.template vertex<dim>(v);
      for (unsigned int l = 0; l < cell->n_lines(); ++l)
        places[cell->line(l)->child(0)->vertex_index(1)] = mean(cell->line(l));
      if constexpr (dim == 3)
        if (kind.is_hyper_cube())
          for (const auto &face : cell->face_iterators())
            places[face->child(0)->vertex_index(3)] = mean(face);
      return places;
    }

    /** Where its vertices are in its coarse cell. */
    template <int dim>
    std::vector<Point<dim>>
    vertices_in_coarse_cell(const CellOf<dim> &cell)
    {
      std::vector<Point<dim>> result;
      if (cell->level() == 0)
        {
          for (const unsigned int v : cell->vertex_indices())
            result.push_back(cell->reference_cell().template vertex<dim>(v));
          return result;
        }
      const CellOf<dim>             parent = cell->parent();
      const std::vector<Point<dim>> above =
        vertices_in_coarse_cell<dim>(parent);
      const auto places = unit_places<dim>(parent);
      for (const unsigned int v : cell->vertex_indices())
        {
          const auto       found = places.find(cell->vertex_index(v));
          const Point<dim> unit =
            found == places.end() ?
              cell->reference_cell().template barycenter<dim>() :
              found->second;
          Point<dim> sum;
          for (const unsigned int w : parent->vertex_indices())
            sum += above[w] *
                   parent->reference_cell().d_linear_shape_function(unit, w);
          result.push_back(sum);
        }
      return result;
    }

    /** The place in the mesh of a place in a coarse cell. */
    template <int dim>
    Point<dim>
    on_curve(const std::vector<Point<dim>>    &nodes,
             const dealii::FiniteElement<dim> &fe,
             const Point<dim>                 &unit)
    {
      Point<dim> sum;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        sum += fe.shape_value(i, unit) * nodes[i];
      return sum;
    }

    template <int dim>
    CellOf<dim>
    coarse_cell(CellOf<dim> cell)
    {
      while (cell->level() > 0)
        cell = cell->parent();
      return cell;
    }
  } // namespace

  template <int dim>
  typename CellNodes<dim>::Nodes
  CellNodes<dim>::of_cell(const Cell &cell) const
  {
    if (!active.empty())
      return active[cell->active_cell_index()];
    const Cell top = coarse_cell<dim>(cell);
    AssertIndexRange(top->index(), coarse.size());
    const Nodes &given = coarse[top->index()];
    if (cell->level() == 0)
      return given;
    const auto  kind     = cell->reference_cell();
    const auto &fe       = second_order<dim>(kind);
    const auto  vertices = vertices_in_coarse_cell<dim>(cell);
    Nodes       result;
    for (const Point<dim> &p : fe.get_unit_support_points())
      {
        Point<dim> unit;
        for (const unsigned int v : cell->vertex_indices())
          unit += vertices[v] * kind.d_linear_shape_function(p, v);
        result.push_back(on_curve(given, fe, unit));
      }
    return result;
  }

  template <int dim>
  void
  CellNodes<dim>::transform(
    const std::function<Point<dim>(const Point<dim> &)> &move)
  {
    for (auto *const all : {&coarse, &active})
      for (Nodes &nodes : *all)
        for (Point<dim> &p : nodes)
          p = move(p);
  }

  template <int dim>
  CellNodes<dim>
  make_cell_nodes(const Triangulation<dim>                            &mesh,
                  const std::function<Point<dim>(const unsigned int,
                                                 const unsigned int)> &middle)
  {
    CellNodes<dim> result;
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      {
        typename CellNodes<dim>::Nodes nodes;
        for (const unsigned int v : cell->vertex_indices())
          nodes.push_back(cell->vertex(v));
        for (unsigned int l = 0; l < cell->n_lines(); ++l)
          nodes.push_back(middle(cell->line(l)->vertex_index(0),
                                 cell->line(l)->vertex_index(1)));
        const bool is_cube = cell->reference_cell().is_hyper_cube();
        if constexpr (dim == 3)
          if (is_cube)
            for (const auto &face : cell->face_iterators())
              nodes.push_back(
                middle(face->vertex_index(0), face->vertex_index(3)));
        if (is_cube)
          nodes.push_back(middle(cell->vertex_index(0),
                                 cell->vertex_index(cell->n_vertices() - 1)));
        result.coarse.push_back(std::move(nodes));
      }
    return result;
  }

  template <int dim>
  void
  bend_refined_cells(const CellNodes<dim> &nodes, Triangulation<dim> &mesh)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->level() > 0)
        {
          const auto places = nodes.of_cell(cell);
          for (const unsigned int v : cell->vertex_indices())
            cell->vertex(v) = places[v];
        }
  }

  template struct CellNodes<2>;
  template struct CellNodes<3>;
  template CellNodes<2>
  make_cell_nodes(
    const Triangulation<2> &,
    const std::function<Point<2>(const unsigned int, const unsigned int)> &);
  template CellNodes<3>
  make_cell_nodes(
    const Triangulation<3> &,
    const std::function<Point<3>(const unsigned int, const unsigned int)> &);
  template void
  bend_refined_cells(const CellNodes<2> &, Triangulation<2> &);
  template void
  bend_refined_cells(const CellNodes<3> &, Triangulation<3> &);
} // namespace conetact::bodies
