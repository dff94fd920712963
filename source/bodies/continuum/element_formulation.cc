// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/element_formulation.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

namespace conetact::bodies
{
  using dealii::GeometryInfo;
  using dealii::Tensor;

  namespace
  {
    /** Distance from the axis of a point with these shape values. */
    template <int dim, class Shapes>
    double
    radius(const std::vector<dealii::Point<dim>> &vertices, const Shapes &N)
    {
      double r = 0;
      for (int v = 0; v < N.size(); ++v)
        r += N[v] * vertices[static_cast<std::size_t>(v)][0];
      return r;
    }
  } // namespace

  template <int dim>
  DLinearElement<dim>::DLinearElement(const ElasticMaterial &material)
    : Base(material)
  {
    const dealii::QGauss<dim> gauss(2);
    points       = gauss.get_points();
    unit_weights = gauss.get_weights();
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        at_points.push_back(unit_gradients(points[q]));
        for (unsigned int v = 0; v < n_vertices; ++v)
          shapes(v, q) =
            GeometryInfo<dim>::d_linear_shape_function(points[q], v);
      }
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        corners.push_back(GeometryInfo<dim>::unit_cell_vertex(v));
        at_corners.push_back(unit_gradients(corners.back()));
      }
  }

  template <int dim>
  typename DLinearElement<dim>::template Gradients<
    DLinearElement<dim>::n_vertices>
  DLinearElement<dim>::unit_gradients(const dealii::Point<dim> &p)
  {
    Gradients<n_vertices> gradients;
    for (unsigned int v = 0; v < n_vertices; ++v)
      gradients[v] = GeometryInfo<dim>::d_linear_shape_function_gradient(p, v);
    return gradients;
  }

  template <int dim>
  Tensor<2, dim>
  DLinearElement<dim>::jacobian(const Vertices              &vertices,
                                const Gradients<n_vertices> &unit)
  {
    Tensor<2, dim> j;
    for (unsigned int v = 0; v < n_vertices; ++v)
      j += outer_product(vertices[v], unit[v]);
    return j;
  }

  template <int dim>
  typename DLinearElement<dim>::StrainField
  DLinearElement<dim>::d_linear(const Vertices &vertices,
                                const bool      with_vertices) const
  {
    StrainField field;
    field.at_points.reserve(n_vertices);
    field.at_vertices.reserve(with_vertices ? n_vertices : 0);
    const auto add = [&](const Gradients<n_vertices>                &unit,
                         const Eigen::Matrix<double, n_vertices, 1> &N,
                         std::vector<Columns>                       &strains) {
      const Tensor<2, dim>  j       = jacobian(vertices, unit);
      const Tensor<2, dim>  inverse = invert(j);
      Gradients<n_vertices> gradients;
      for (unsigned int v = 0; v < n_vertices; ++v)
        // dN/dx = dN/dxi dxi/dx, with the Jacobian dx/dxi at the point itself.
        gradients[v] = unit[v] * inverse;
      auto   b    = this->template strain_matrix<n_vertices>(gradients);
      double size = 1; // of the cell along what the mesh does not show
      if (this->is_ring)
        {
          const double r = radius(vertices, N);
          this->template go_round<n_vertices>(vertices, N, r, b);
          size = 2 * dealii::numbers::PI * r;
        }
      strains.push_back(b);
      return size * determinant(j);
    };
    for (unsigned int q = 0; q < at_points.size(); ++q)
      field.weights.push_back(unit_weights[q] *
                              add(at_points[q],
                                  shapes.col(static_cast<Eigen::Index>(q)),
                                  field.at_points));
    if (with_vertices)
      // Stresses are those of the vertices themselves, not continued from the
      // points.
      for (int v = 0; v < n_vertices; ++v)
        add(at_corners[static_cast<std::size_t>(v)],
            Eigen::Matrix<double, n_vertices, 1>::Unit(v),
            field.at_vertices);
    return field;
  }

  template <int dim>
  typename DLinearElement<dim>::Matrix
  DLinearElement<dim>::stiffness(const Vertices &vertices) const
  {
    StrainField b = d_linear(vertices, false);
    // K = int B^T C B with the strains that the element has improved.
    improve(vertices, b);
    Eigen::Matrix<double, n_dofs, n_dofs> k =
      Eigen::Matrix<double, n_dofs, n_dofs>::Zero();
    constexpr int part = 2 * dim; // what is above the diagonal is not needed
    for (std::size_t q = 0; q < b.weights.size(); ++q)
      {
        const Eigen::Matrix<double, n_strains, n_dofs> of_dofs = b.at_points[q];
        const Eigen::Matrix<double, n_strains, n_dofs> stress =
          // Products of matrices this small are faster entry by entry.
          (b.weights[q] * this->c).lazyProduct(of_dofs);
        for (int j = 0; j < n_dofs; j += part)
          for (int i = j; i < n_dofs; i += part)
            k.template block<part, part>(i, j) +=
              of_dofs.template middleCols<part>(i).transpose().lazyProduct(
                stress.template middleCols<part>(j));
      }
    // Half of it copied: symmetric to the last bit.
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }

  template <int dim>
  typename DLinearElement<dim>::Displacements
  DLinearElement<dim>::forces(const Vertices &vertices,
                              const Strains  &initial) const
  {
    StrainField b = d_linear(vertices, false);
    improve(vertices, b);
    Displacements f = Displacements::Zero(n_dofs);
    for (std::size_t q = 0; q < b.weights.size(); ++q)
      f += b.at_points[q].transpose() *
           (b.weights[q] *
            (this->c * (initial * shapes.col(static_cast<Eigen::Index>(q)))));
    return f;
  }

  template <int dim>
  typename DLinearElement<dim>::Strains
  DLinearElement<dim>::stresses(const Vertices      &vertices,
                                const Displacements &u,
                                const Strains       &initial) const
  {
    StrainField strains = d_linear(vertices, true);
    for (std::size_t i = 0; i < n_vertices; ++i)
      {
        // There are as many points as vertices. Initial strains are taken off
        // before the element improves the rest: it is stress that internal
        // modes answer to.
        const auto column = static_cast<Eigen::Index>(i);
        strains.at_points[i] =
          (strains.at_points[i] * u - initial * shapes.col(column)).eval();
        strains.at_vertices[i] =
          (strains.at_vertices[i] * u - initial.col(column)).eval();
      }
    improve(vertices, strains);
    Strains result(n_strains, n_vertices);
    for (std::size_t v = 0; v < n_vertices; ++v)
      result.col(static_cast<Eigen::Index>(v)) =
        this->c * strains.at_vertices[v];
    return result;
  }



  template <int dim>
  std::vector<typename LinearElement<dim>::PointOfCell>
  LinearElement<dim>::at(const Vertices        &vertices,
                         const Eigen::MatrixXd &shapes) const
  {
    Tensor<2, dim> edges; // columns, from the first vertex
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int v = 0; v < dim; ++v)
        edges[d][v] = vertices[v + 1][d] - vertices[0][d];
    const Tensor<2, dim> inverse = invert(edges);

    typename Base::template Gradients<n_vertices> gradients;
    for (unsigned int v = 0; v < dim; ++v)
      {
        // Barycentric coordinates: the one of vertex v + 1 grows along its
        // edge, that of the first takes what keeps their sum at 1.
        gradients[v + 1] = inverse[v];
        gradients[0] -= inverse[v];
      }
    const auto   b      = this->template strain_matrix<n_vertices>(gradients);
    const double volume = determinant(edges) / (dim == 2 ? 2 : 6) /
                          static_cast<double>(shapes.rows());
    std::vector<PointOfCell> result;
    for (Eigen::Index q = 0; q < shapes.rows(); ++q)
      {
        result.push_back({b, shapes.row(q).transpose(), volume});
        PointOfCell &point = result.back();
        if (!this->is_ring)
          continue;
        const double r = radius(vertices, point.shapes);
        this->template go_round<n_vertices>(vertices, point.shapes, r, point.b);
        point.volume *= 2 * dealii::numbers::PI * r;
      }
    return result;
  }

  /* Strains round an axis are not uniform, and in one point a triangle would
     turn about it without strain. Three integrate r times a linear strain as
     it is. */
  template <int dim>
  std::vector<typename LinearElement<dim>::PointOfCell>
  LinearElement<dim>::points(const Vertices &vertices) const
  {
    if (!this->is_ring)
      return at(vertices,
                Eigen::MatrixXd::Constant(1, n_vertices, 1. / n_vertices));
    Eigen::MatrixXd shapes =
      Eigen::MatrixXd::Constant(n_vertices, n_vertices, 1. / 6);
    shapes.diagonal().setConstant(2. / 3);
    return at(vertices, shapes);
  }

  template <int dim>
  std::vector<typename LinearElement<dim>::PointOfCell>
  LinearElement<dim>::corners(const Vertices &vertices) const
  {
    return at(vertices, Eigen::MatrixXd::Identity(n_vertices, n_vertices));
  }

  template <int dim>
  typename LinearElement<dim>::Matrix
  LinearElement<dim>::stiffness(const Vertices &vertices) const
  {
    Matrix k = Matrix::Zero(n_dofs, n_dofs);
    for (const PointOfCell &p : points(vertices))
      k += p.b.transpose() * (p.volume * this->c) * p.b;
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }

  template <int dim>
  typename LinearElement<dim>::Displacements
  LinearElement<dim>::forces(const Vertices &vertices,
                             const Strains  &initial) const
  {
    Displacements f = Displacements::Zero(n_dofs);
    for (const PointOfCell &p : points(vertices))
      f += p.b.transpose() * (p.volume * this->c * (initial * p.shapes));
    return f;
  }

  template <int dim>
  typename LinearElement<dim>::Strains
  LinearElement<dim>::stresses(const Vertices      &vertices,
                               const Displacements &u,
                               const Strains       &initial) const
  {
    Strains    result(n_strains, n_vertices);
    const auto at_corners = corners(vertices);
    for (std::size_t v = 0; v < n_vertices; ++v)
      {
        const auto column = static_cast<Eigen::Index>(v);
        result.col(column) =
          this->c * (at_corners[v].b * u - initial.col(column));
      }
    return result;
  }

  template class DLinearElement<2>;
  template class DLinearElement<3>;
  template class LinearElement<2>;
  template class LinearElement<3>;
} // namespace conetact::bodies
