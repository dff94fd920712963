// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/boundary_faces.h"

#include "conetact/bodies/face_nodes.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>
#include <memory>
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
    std::unique_ptr<FiniteElement<dim - 1>>
    element_of_faces(const bool has_simplices, const unsigned int degree)
    {
      if (dim == 3 && has_simplices)
        return std::make_unique<FE_SimplexP<dim - 1>>(degree);
      return std::make_unique<FE_Q<dim - 1>>(degree);
    }

    /** Area times normal of the face that tangents span. */
    Tensor<1, 2>
    across(const Tensor<1, 2> (&tangents)[1])
    {
      return cross_product_2d(tangents[0]);
    }
    Tensor<1, 3>
    across(const Tensor<1, 3> (&tangents)[2])
    {
      return cross_product_3d(tangents[0], tangents[1]);
    }

    /** Whether the normal of the first `dim` nodes of a face points out of its
     * cell, 1, or into it, -1: as it does on the unit cell. */
    template <int dim>
    double
    side_of(const std::vector<Point<dim>> &unit_nodes, const Point<dim> &centre)
    {
      Tensor<1, dim> tangents[dim - 1];
      for (unsigned int d = 0; d + 1 < dim; ++d)
        tangents[d] = unit_nodes[d + 1] - unit_nodes[0];
      return across(tangents) * (unit_nodes[0] - centre) > 0 ? 1 : -1;
    }

    template <int dim>
    Point<dim>
    mean(const std::vector<Point<dim>> &points, const unsigned int n)
    {
      Point<dim> sum;
      for (unsigned int i = 0; i < n; ++i)
        sum += Tensor<1, dim>(points[i]) / n;
      return sum;
    }

    template <int dim>
    typename BoundaryFaces<dim>::Face
    make_face(const Discretization<dim>                        &body,
              const typename Discretization<dim>::CellIterator &cell,
              const unsigned int                                number)
    {
      const FESystem<dim> &fe      = body.fe;
      const auto           face    = cell->face(number);
      const auto           of_cell = body.nodes_of(cell);
      const auto          &unit = fe.base_element(0).get_unit_support_points();
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_face(number));
      face->get_dof_indices(dofs, cell->active_fe_index());
      typename BoundaryFaces<dim>::Face result{face->boundary_id(), 0, {}};
      std::vector<Point<dim>>           unit_nodes;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          if (fe.face_system_to_component_index(i, number).first != 0)
            continue;
          result.nodes.push_back(static_cast<unsigned int>(dofs[i] / dim));
          // The face's own order of nodes is not that of its cell.
          const auto place =
            std::find(of_cell.begin(), of_cell.end(), result.nodes.back());
          Assert(place != of_cell.end(), ExcInternalError());
          unit_nodes.push_back(
            unit[static_cast<std::size_t>(place - of_cell.begin())]);
        }
      result.side = side_of<dim>(unit_nodes, mean(unit, cell->n_vertices()));
      return result;
    }
  } // namespace

  template <int dim>
  FaceValues<dim>::FaceValues(const Discretization<dim> &body)
  {
    const auto fe = element_of_faces<dim>(body.has_simplices(), body.fe.degree);
    const auto rule = quadrature_of_faces<dim>(body.has_simplices());
    weights         = rule.get_weights();
    for (const Point<dim - 1> &q : rule.get_points())
      {
        shapes.emplace_back();
        gradients.emplace_back();
        for (unsigned int v = 0; v < fe->dofs_per_cell; ++v)
          {
            shapes.back().push_back(fe->shape_value(v, q));
            gradients.back().push_back(fe->shape_grad(v, q));
          }
      }
    points.resize(weights.size());
    normals.resize(weights.size());
    areas.resize(weights.size());
  }

  template <int dim>
  void
  FaceValues<dim>::reinit(const ContinuumMesh<dim>        &mesh,
                          const std::vector<unsigned int> &nodes,
                          const double                     side)
  {
    AssertDimension(nodes.size(), shapes[0].size());
    for (std::size_t q = 0; q < weights.size(); ++q)
      {
        Tensor<1, dim> tangents[dim - 1];
        points[q] = Point<dim>();
        for (std::size_t v = 0; v < nodes.size(); ++v)
          {
            const Tensor<1, dim> x(mesh.nodes[nodes[v]]);
            points[q] += shapes[q][v] * x;
            for (unsigned int d = 0; d + 1 < dim; ++d)
              tangents[d] += gradients[q][v][d] * x;
          }
        const Tensor<1, dim> a = across(tangents);
        areas[q]               = weights[q] * a.norm();
        normals[q]             = side / a.norm() * a;
      }
  }

  template <int dim>
  BoundaryFaces<dim>::BoundaryFaces(const Discretization<dim> &body)
    : values(body)
  {
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          faces.push_back(make_face(body, cell, f));
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

  template class FaceValues<2>;
  template class FaceValues<3>;
  template class BoundaryFaces<2>;
  template class BoundaryFaces<3>;
} // namespace conetact::bodies
