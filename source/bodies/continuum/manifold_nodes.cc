// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/manifold_nodes.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/manifold.h>

#include <algorithm>
#include <map>

namespace conetact::bodies
{
  using dealii::Point;
  using dealii::Triangulation;

  namespace
  {
    template <int dim>
    bool
    is_curved(const Triangulation<dim> &mesh)
    {
      const auto ids = mesh.get_manifold_ids();
      return std::any_of(ids.begin(), ids.end(), [](const auto id) {
        return id != dealii::numbers::flat_manifold_id;
      });
    }

    template <int dim>
    typename CellNodes<dim>::Nodes
    of_simplex(const typename CellNodes<dim>::Cell &cell)
    {
      typename CellNodes<dim>::Nodes nodes;
      for (const unsigned int v : cell->vertex_indices())
        nodes.push_back(cell->vertex(v));
      for (unsigned int l = 0; l < cell->n_lines(); ++l)
        nodes.push_back(cell->line(l)->center(/*respect_manifold=*/true));
      return nodes;
    }

    template <int dim>
    typename CellNodes<dim>::Nodes
    of_hypercube(const typename CellNodes<dim>::Cell &cell)
    {
      static const dealii::MappingQ<dim> mapping(2);
      static const dealii::FE_Q<dim>     fe(2);
      typename CellNodes<dim>::Nodes     nodes;
      for (const Point<dim> &p : fe.get_unit_support_points())
        nodes.push_back(mapping.transform_unit_to_real_cell(cell, p));
      for (const unsigned int v : cell->vertex_indices())
        nodes[v] = cell->vertex(v); // without rounding
      return nodes;
    }

    /** Straight centres with the curved ones, by the first coordinate. */
    template <int dim>
    class BentCentres
    {
    public:
      explicit BentCentres(const Triangulation<dim> &mesh)
      {
        for (const auto &cell : mesh.active_cell_iterators())
          {
            size = std::max(size, cell->center().norm() + cell->diameter());
            add(*cell);
            for (unsigned int l = 0; l < cell->n_lines(); ++l)
              add(*cell->line(l));
            if constexpr (dim == 3)
              for (const auto &face : cell->face_iterators())
                add(*face);
          }
      }

      void
      move(Point<dim> &p) const
      {
        const double rounding = 1e-12 * size;
        const auto   end      = all.upper_bound(p[0] + rounding);
        for (auto at = all.lower_bound(p[0] - rounding); at != end; ++at)
          if (at->second.first.distance(p) <= rounding)
            {
              p = at->second.second;
              return;
            }
      }

    private:
      template <class Object>
      void
      add(const Object &object)
      {
        const Point<dim> straight = object.center();
        const Point<dim> bent     = object.center(/*respect_manifold=*/true);
        if (straight.distance(bent) > 1e-12 * object.diameter())
          all.emplace(straight[0], std::make_pair(straight, bent));
      }

      std::multimap<double, std::pair<Point<dim>, Point<dim>>> all;
      double                                                   size = 0;
    };
  } // namespace

  template <int dim>
  CellNodes<dim>
  nodes_on_manifolds(const Triangulation<dim> &mesh)
  {
    CellNodes<dim> result;
    if (!is_curved(mesh))
      return result;
    for (const auto &cell : mesh.active_cell_iterators())
      result.active.push_back(cell->reference_cell().is_simplex() ?
                                of_simplex<dim>(cell) :
                                of_hypercube<dim>(cell));
    return result;
  }

  template <int dim>
  void
  bend_divided_cells(const Triangulation<dim> &whole,
                     Triangulation<dim>       &divided)
  {
    if (!is_curved(whole))
      return;
    const BentCentres<dim> centres(whole);
    std::vector<bool>      done(divided.n_vertices(), false);
    for (const auto &cell : divided.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        if (!done[cell->vertex_index(v)])
          {
            centres.move(cell->vertex(v));
            done[cell->vertex_index(v)] = true;
          }
  }

  template CellNodes<2>
  nodes_on_manifolds(const Triangulation<2> &);
  template CellNodes<3>
  nodes_on_manifolds(const Triangulation<3> &);
  template void
  bend_divided_cells(const Triangulation<2> &, Triangulation<2> &);
  template void
  bend_divided_cells(const Triangulation<3> &, Triangulation<3> &);
} // namespace conetact::bodies
