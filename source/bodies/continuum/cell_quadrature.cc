// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_quadrature.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <Eigen/LU>

#include <algorithm>

namespace conetact::bodies
{
  using namespace dealii;

  namespace
  {
    /** How far outside its cell, in cell sizes, a point may be by round-off. */
    constexpr double point_tolerance = 1e-6;

    template <int dim>
    std::unique_ptr<FiniteElement<dim>>
    element_of_map(const bool simplices)
    {
      if (simplices)
        return std::make_unique<FE_SimplexP<dim>>(1);
      return std::make_unique<FE_Q<dim>>(1);
    }

    /** How far a point of the unit cell's space is outside of the cell. */
    template <int dim>
    double
    distance_to_unit_cell(const Point<dim> &p, const bool simplex)
    {
      // Inside a simplex all coordinates are above 0, and their sum is below 1.
      if (!simplex)
        return GeometryInfo<dim>::distance_to_unit_cell(p);
      double distance = -1, sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          distance = std::max(distance, -p[d]);
          sum += p[d];
        }
      return std::max({distance, sum - 1, 0.});
    }
  } // namespace

  template <int dim>
  CellQuadrature<dim>::CellQuadrature(const Discretization<dim> &body)
    : simplices(body.has_simplices())
    , mapping(body.mapping)
    , fe(body.fe.clone())
  {
    const auto linear = element_of_map<dim>(simplices);
    n_vertices        = linear->dofs_per_cell;
    weights           = body.quadrature.get_weights();
    for (const Point<dim> &q : body.quadrature.get_points())
      {
        shapes.push_back(shapes_at(q));
        map.emplace_back(n_vertices);
        map_gradients.emplace_back(n_vertices, dim);
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            map.back()[v] = linear->shape_value(v, q);
            for (unsigned int d = 0; d < dim; ++d)
              map_gradients.back()(v, d) = linear->shape_grad(v, q)[d];
          }
      }
  }

  template <int dim>
  Eigen::VectorXd
  CellQuadrature<dim>::shapes_at(const Point<dim> &unit) const
  {
    Eigen::VectorXd values(fe->dofs_per_cell / dim);
    for (unsigned int v = 0; v < values.size(); ++v)
      values[v] = fe->shape_value(fe->component_to_system_index(0, v), unit);
    return values;
  }

  template <int dim>
  void
  CellQuadrature<dim>::for_each_point(const ContinuumMesh<dim> &mesh,
                                      const unsigned int        cell,
                                      const Visit              &visit) const
  {
    const auto                                 nodes = mesh.cell(cell);
    Eigen::Matrix<double, dim, Eigen::Dynamic> x(dim, n_vertices);
    for (unsigned int v = 0; v < n_vertices; ++v)
      for (unsigned int d = 0; d < dim; ++d)
        x(d, v) = mesh.nodes[nodes[v]][d];
    for (std::size_t q = 0; q < weights.size(); ++q)
      {
        const Eigen::Matrix<double, dim, dim> J     = x * map_gradients[q];
        const Eigen::Matrix<double, dim, 1>   place = x * map[q];
        Point<dim>                            p;
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = place[d];
        visit(p, J.determinant() * weights[q], shapes[q]);
      }
  }

  template <int dim>
  std::optional<Point<dim>>
  CellQuadrature<dim>::in_unit_cell(const std::vector<Point<dim>> &vertices,
                                    const Point<dim>              &p) const
  {
    CellData<dim> data(n_vertices);
    for (unsigned int v = 0; v < n_vertices; ++v)
      data.vertices[v] = v;
    Triangulation<dim> cell;
    cell.create_triangulation({vertices.begin(), vertices.begin() + n_vertices},
                              {data},
                              SubCellData());
    try
      {
        return mapping.transform_real_to_unit_cell(cell.begin(), p);
      }
    catch (const typename Mapping<dim>::ExcTransformationFailed &)
      {
        return {}; // far outside a distorted cell
      }
  }

  /* A plain loop: trees of cells take longer to make than a point to find.
     Between cells round-off may put a point outside of all of them. */
  template <int dim>
  std::optional<typename CellQuadrature<dim>::Place>
  CellQuadrature<dim>::find(const ContinuumMesh<dim> &mesh,
                            const Point<dim>         &p) const
  {
    std::optional<Place> found;
    double               nearest = point_tolerance;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const std::vector<Point<dim>> vertices = mesh.vertices(cell);
        if (!BoundingBox<dim>(
               std::vector<Point<dim>>(vertices.begin(),
                                       vertices.begin() + n_vertices))
               .point_inside(p, point_tolerance))
          continue;
        const auto unit = in_unit_cell(vertices, p);
        if (!unit)
          continue;
        if (const double distance = distance_to_unit_cell(*unit, simplices);
            distance < nearest)
          {
            nearest = distance;
            found   = Place{cell, shapes_at(*unit)};
          }
      }
    return found;
  }

  template class CellQuadrature<2>;
  template class CellQuadrature<3>;
} // namespace conetact::bodies
