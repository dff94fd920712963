// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/boundary_faces.h"

#include "conetact/bodies/continuum/halved_cells.h"
#include "conetact/bodies/face_nodes.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <set>

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

    template <int dim>
    typename BoundaryFaces<dim>::Face
    make_face(const Discretization<dim>                        &body,
              const typename Discretization<dim>::CellIterator &cell,
              const unsigned int                                number)
    {
      const auto                        of_cell = body.nodes_of(cell);
      typename BoundaryFaces<dim>::Face face{cell->face(number)->boundary_id(),
                                             cell->active_cell_index(),
                                             number,
                                             body.nodes_of_face(cell, number),
                                             {}};
      for (const unsigned int node : face.nodes)
        {
          // The face's own order of nodes is not that of its cell.
          const auto place = std::find(of_cell.begin(), of_cell.end(), node);
          Assert(place != of_cell.end(), ExcInternalError());
          face.in_cell.push_back(
            static_cast<unsigned int>(place - of_cell.begin()));
        }
      return face;
    }
  } // namespace

  template <int dim>
  BoundaryFaces<dim>::BoundaryFaces(const Discretization<dim> &body,
                                    const ContinuumMesh<dim>  *halved_mesh)
    : mapping(body.fe.base_element(0))
    , values(mapping,
             mapping.element(),
             quadrature_of_faces<dim>(body.has_simplices()),
             update_values | update_quadrature_points | update_normal_vectors |
               update_JxW_values)
  {
    for (const auto &cell : body.triangulation->active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          faces.push_back(make_face(body, cell, f));
    if (halved_mesh != nullptr)
      faces = halved(faces, *halved_mesh);
    faces.shrink_to_fit();
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

  template <int dim>
  bool
  BoundaryFaces<dim>::have_hanging_nodes(const ContinuumMesh<dim> &mesh) const
  {
    std::set<unsigned int> hanging;
    for (const HangingNode &node : mesh.hanging)
      hanging.insert(node.node);
    return std::any_of(faces.begin(), faces.end(), [&](const Face &face) {
      return std::any_of(face.nodes.begin(),
                         face.nodes.end(),
                         [&](const unsigned int node) {
                           return hanging.count(node) > 0;
                         });
    });
  }

  template <int dim>
  bool
  BoundaryFaces<dim>::is_bent(const ContinuumMesh<dim> &mesh) const
  {
    constexpr double digits = 1e-6; // of mesh files, over the size of a face
    return std::any_of(faces.begin(), faces.end(), [&](const Face &face) {
      const auto at = [&](const std::size_t i) -> const Point<dim> & {
        return mesh.nodes[face.nodes[i]];
      };
      return bodies::is_bent(dim,
                             face.nodes.size(),
                             at,
                             digits * at(0).distance(at(1)));
    });
  }

  template class BoundaryFaces<2>;
  template class BoundaryFaces<3>;
} // namespace conetact::bodies
