// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_cell_quadrature_h
#define conetact_bodies_continuum_cell_quadrature_h

#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/discretization.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>

namespace conetact::bodies
{
  /**
   * Integrals over cells, and shape functions at points of them, from the
   * nodes of a ContinuumMesh alone. Positions are interpolated as displacements
   * are. Vertices are the first nodes of a cell.
   */
  template <int dim>
  class CellQuadrature
  {
  public:
    explicit CellQuadrature(const Discretization<dim> &body);

    bool
    has_simplices() const
    {
      return simplices;
    }
    unsigned int
    degree() const
    {
      return fe->degree;
    }

    /** A quadrature point: where it is, its weight times the determinant of
     * the map from the unit cell [length^dim], shape functions of the nodes. */
    using Visit = std::function<void(const Point<dim>      &p,
                                     const double           dx,
                                     const Eigen::VectorXd &shapes)>;
    void
    for_each_point(const ContinuumMesh<dim> &mesh,
                   const unsigned int        cell,
                   const Visit              &visit) const;

    /** The least determinant of the map from the unit cell, at quadrature
     * points and nodes [length^dim]. */
    double
    least_volume(const ContinuumMesh<dim> &mesh, const unsigned int cell) const;
    /** Mean of its vertices. */
    Point<dim>
    middle(const ContinuumMesh<dim> &mesh, const unsigned int cell) const;

    /** A point of a body: its cell, and shape functions of the nodes there. */
    struct Place
    {
      unsigned int    cell;
      Eigen::VectorXd shapes;
    };
    /** The nearest cell; nothing if the point is in none. */
    std::optional<Place>
    find(const ContinuumMesh<dim> &mesh, const Point<dim> &p) const;

  private:
    Eigen::VectorXd
    shapes_at(const Point<dim> &unit) const;
    /** A row for each node. */
    using Gradients = Eigen::Matrix<double, Eigen::Dynamic, dim>;
    Gradients
    gradients_at(const Point<dim> &unit) const;
    std::optional<Point<dim>>
    in_straight_cell(const std::vector<Point<dim>> &nodes,
                     const Point<dim>              &p) const;
    std::optional<Point<dim>>
    in_unit_cell(const std::vector<Point<dim>> &nodes,
                 const Point<dim>              &p) const;

    const bool                                              simplices;
    const dealii::Mapping<dim>                             &straight;
    const std::unique_ptr<const dealii::FiniteElement<dim>> fe;
    unsigned int                                            n_vertices;
    std::vector<double>                                     weights;
    std::vector<Eigen::VectorXd> shapes; ///< at quadrature points
    std::vector<Gradients>       gradients, at_nodes;
  };
} // namespace conetact::bodies

#endif
