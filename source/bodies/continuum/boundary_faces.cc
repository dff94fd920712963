// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/boundary_faces.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <map>

namespace conetact::bodies
{
  using namespace dealii;

  namespace
  {
    /** Three points a direction; lines are the faces of triangles, too. */
    template <int dim>
    Quadrature<dim - 1>
    quadrature_of_faces(const bool has_simplices)
    {
      if (dim == 3 && has_simplices)
        return QGaussSimplex<dim - 1>(3);
      return QGauss<dim - 1>(3);
    }
  } // namespace

  template <int dim>
  BoundaryFaces<dim>::BoundaryFaces(const Discretization<dim> &body)
    : mapping(body.mapping)
    , fe(body.fe.clone())
    , quadrature(quadrature_of_faces<dim>(body.has_simplices()))
  {
    std::vector<typename Discretization<dim>::CellIterator> kept;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          {
            if (kept.empty() || kept.back() != cell)
              kept.push_back(cell);
            faces.push_back(make_face(body, cell, f));
            faces.back().cell = static_cast<unsigned int>(kept.size() - 1);
          }
    keep_cells(kept);
  }

  template <int dim>
  typename BoundaryFaces<dim>::Face
  BoundaryFaces<dim>::make_face(
    const Discretization<dim>                        &body,
    const typename Discretization<dim>::CellIterator &cell,
    const unsigned int                                number) const
  {
    const auto face    = cell->face(number);
    const auto of_cell = body.nodes_of(cell);
    Face       result{0, number, face->boundary_id(), {}, {}};
    std::vector<types::global_dof_index> dofs(fe->n_dofs_per_face(number));
    face->get_dof_indices(dofs, cell->active_fe_index());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (fe->face_system_to_component_index(i, number).first != 0)
          continue;
        result.nodes.push_back(static_cast<unsigned int>(dofs[i] / dim));
        // The face's own order of nodes is not that of its cell.
        const auto place =
          std::find(of_cell.begin(), of_cell.end(), result.nodes.back());
        result.shapes.push_back(fe->component_to_system_index(
          0, static_cast<unsigned int>(place - of_cell.begin())));
      }
    return result;
  }

  /* Cells of any level, side by side: that they hang together does not matter
     to faces. */
  template <int dim>
  void
  BoundaryFaces<dim>::keep_cells(
    const std::vector<typename Discretization<dim>::CellIterator> &kept)
  {
    std::map<unsigned int, unsigned int> number;
    std::vector<Point<dim>>              vertices;
    std::vector<CellData<dim>>           data;
    for (const auto &cell : kept)
      {
        CellData<dim> &own = data.emplace_back(cell->n_vertices());
        for (const unsigned int v : cell->vertex_indices())
          {
            const auto [it, is_new] =
              number.emplace(cell->vertex_index(v),
                             static_cast<unsigned int>(vertices.size()));
            if (is_new)
              vertices.push_back(cell->vertex(v));
            own.vertices[v] = it->second;
          }
      }
    cells.create_triangulation(vertices, data, SubCellData());
  }

  template <int dim>
  BoundaryIds
  BoundaryFaces<dim>::ids() const
  {
    BoundaryIds result;
    for (const Face &face : faces)
      result.insert(face.id);
    return result;
  }

  template class BoundaryFaces<2>;
  template class BoundaryFaces<3>;
} // namespace conetact::bodies
