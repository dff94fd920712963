// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_quadrature.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>

#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace conetact::bodies
{
  using namespace dealii;

  namespace
  {
    /** How far outside its cell, in cell sizes, a point may be by round-off. */
    constexpr double point_tolerance = 1e-6;
    /** How far bent edges reach beyond the box around the nodes, in its size.
     */
    constexpr double bulge = .25;

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
    , straight(body.mapping)
    , fe(body.fe.base_element(0).clone())
    , n_vertices(body.fe.reference_cell().n_vertices())
    , weights(body.quadrature.get_weights())
  {
    for (const Point<dim> &q : body.quadrature.get_points())
      {
        shapes.push_back(shapes_at(q));
        gradients.push_back(gradients_at(q));
      }
    for (const Point<dim> &p : fe->get_unit_support_points())
      at_nodes.push_back(gradients_at(p));
  }

  template <int dim>
  Eigen::VectorXd
  CellQuadrature<dim>::shapes_at(const Point<dim> &unit) const
  {
    Eigen::VectorXd values(fe->dofs_per_cell);
    for (unsigned int v = 0; v < values.size(); ++v)
      values[v] = fe->shape_value(v, unit);
    return values;
  }

  template <int dim>
  typename CellQuadrature<dim>::Gradients
  CellQuadrature<dim>::gradients_at(const Point<dim> &unit) const
  {
    Gradients result(fe->dofs_per_cell, dim);
    for (unsigned int v = 0; v < result.rows(); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        result(v, d) = fe->shape_grad(v, unit)[d];
    return result;
  }

  namespace
  {
    /** A column for each node. */
    template <int dim>
    Eigen::Matrix<double, dim, Eigen::Dynamic>
    columns(const std::vector<Point<dim>> &nodes)
    {
      Eigen::Matrix<double, dim, Eigen::Dynamic> x(dim, nodes.size());
      for (unsigned int v = 0; v < nodes.size(); ++v)
        for (unsigned int d = 0; d < dim; ++d)
          x(d, v) = nodes[v][d];
      return x;
    }
  } // namespace

  template <int dim>
  void
  CellQuadrature<dim>::for_each_point(const ContinuumMesh<dim> &mesh,
                                      const unsigned int        cell,
                                      const Visit              &visit) const
  {
    const auto x = columns(mesh.vertices(cell));
    for (std::size_t q = 0; q < weights.size(); ++q)
      {
        const Eigen::Matrix<double, dim, dim> J     = x * gradients[q];
        const Eigen::Matrix<double, dim, 1>   place = x * shapes[q];
        Point<dim>                            p;
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = place[d];
        visit(p, J.determinant() * weights[q], shapes[q]);
      }
  }

  template <int dim>
  double
  CellQuadrature<dim>::least_volume(const ContinuumMesh<dim> &mesh,
                                    const unsigned int        cell) const
  {
    const auto x     = columns(mesh.vertices(cell));
    double     least = std::numeric_limits<double>::max();
    for (const auto *const all : {&gradients, &at_nodes})
      for (const Gradients &g : *all)
        least =
          std::min(least, Eigen::Matrix<double, dim, dim>(x * g).determinant());
    return least;
  }

  template <int dim>
  Point<dim>
  CellQuadrature<dim>::middle(const ContinuumMesh<dim> &mesh,
                              const unsigned int        cell) const
  {
    const auto nodes = mesh.vertices(cell);
    Point<dim> sum;
    for (unsigned int v = 0; v < n_vertices; ++v)
      sum += nodes[v] / n_vertices;
    return sum;
  }

  template <int dim>
  std::optional<Point<dim>>
  CellQuadrature<dim>::in_straight_cell(const std::vector<Point<dim>> &nodes,
                                        const Point<dim>              &p) const
  {
    CellData<dim> data(n_vertices);
    for (unsigned int v = 0; v < n_vertices; ++v)
      data.vertices[v] = v;
    Triangulation<dim> cell;
    cell.create_triangulation({nodes.begin(), nodes.begin() + n_vertices},
                              {data},
                              SubCellData());
    try
      {
        return straight.transform_real_to_unit_cell(cell.begin(), p);
      }
    catch (const typename Mapping<dim>::ExcTransformationFailed &)
      {
        return {}; // far outside a distorted cell
      }
  }

  /** Newton's method from where the point is in the cell of the vertices. */
  template <int dim>
  std::optional<Point<dim>>
  CellQuadrature<dim>::in_unit_cell(const std::vector<Point<dim>> &nodes,
                                    const Point<dim>              &p) const
  {
    constexpr unsigned int    n_steps   = 20;
    constexpr double          round_off = 1e-12, far = 4; // in unit cells
    std::optional<Point<dim>> at = in_straight_cell(nodes, p);
    if (fe->degree == 1)
      return at;
    const auto x = columns(nodes);
    for (unsigned int step = 0; at && step < n_steps; ++step)
      {
        Eigen::Matrix<double, dim, 1> miss = -x * shapes_at(*at);
        for (unsigned int d = 0; d < dim; ++d)
          miss[d] += p[d];
        const Eigen::Matrix<double, dim, 1> move =
          (x * gradients_at(*at)).eval().inverse() * miss;
        for (unsigned int d = 0; d < dim; ++d)
          (*at)[d] += move[d];
        if (move.norm() < round_off)
          return at;
        if (!(at->norm() < far))
          break;
      }
    return {};
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
        const std::vector<Point<dim>> nodes = mesh.vertices(cell);
        if (!BoundingBox<dim>(nodes).point_inside(
              p, fe->degree == 1 ? point_tolerance : bulge))
          continue;
        const auto unit = in_unit_cell(nodes, p);
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
