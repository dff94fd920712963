// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/element_formulation.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

namespace conetact::bodies
{
  using dealii::GeometryInfo;
  using dealii::Tensor;

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
    const auto  add = [&](const Gradients<n_vertices> &unit,
                         std::vector<Columns>        &strains) {
      const Tensor<2, dim>  j       = jacobian(vertices, unit);
      const Tensor<2, dim>  inverse = invert(j);
      Gradients<n_vertices> gradients;
      for (unsigned int v = 0; v < n_vertices; ++v)
        // dN/dx = dN/dxi dxi/dx, with the Jacobian dx/dxi at the point itself.
        gradients[v] = unit[v] * inverse;
      strains.push_back(this->template strain_matrix<n_vertices>(gradients));
      return determinant(j);
    };
    for (unsigned int q = 0; q < at_points.size(); ++q)
      field.weights.push_back(unit_weights[q] *
                              add(at_points[q], field.at_points));
    if (with_vertices)
      // Stresses are those of the vertices themselves, not continued from the
      // points.
      for (const auto &unit : at_corners)
        add(unit, field.at_vertices);
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
    for (std::size_t q = 0; q < b.weights.size(); ++q)
      {
        const Eigen::Matrix<double, n_strains, n_dofs> of_dofs = b.at_points[q];
        const Eigen::Matrix<double, n_strains, n_dofs> stress =
          // Products of matrices this small are faster entry by entry.
          (b.weights[q] * this->c).lazyProduct(of_dofs);
        k += of_dofs.transpose().lazyProduct(stress);
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
  typename LinearElement<dim>::StrainOfCell
  LinearElement<dim>::strain(const Vertices &vertices) const
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
    return {this->template strain_matrix<n_vertices>(gradients),
            determinant(edges) / (dim == 2 ? 2 : 6)};
  }

  template <int dim>
  typename LinearElement<dim>::Matrix
  LinearElement<dim>::stiffness(const Vertices &vertices) const
  {
    const auto [b, volume] = strain(vertices);
    Matrix k               = b.transpose() * (volume * this->c) * b;
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }

  template <int dim>
  typename LinearElement<dim>::Displacements
  LinearElement<dim>::forces(const Vertices &vertices,
                             const Strains  &initial) const
  {
    const auto [b, volume] = strain(vertices); // the mean is what counts
    return b.transpose() * (volume * this->c * initial.rowwise().mean());
  }

  template <int dim>
  typename LinearElement<dim>::Strains
  LinearElement<dim>::stresses(const Vertices      &vertices,
                               const Displacements &u,
                               const Strains       &initial) const
  {
    const Eigen::Matrix<double, n_strains, 1> uniform = strain(vertices).b * u;
    return this->c * (uniform.replicate(1, n_vertices) - initial);
  }

  template class DLinearElement<2>;
  template class DLinearElement<3>;
  template class LinearElement<2>;
  template class LinearElement<3>;
} // namespace conetact::bodies
