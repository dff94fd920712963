// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/element_formulation.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

namespace conetact
{
  using dealii::GeometryInfo;
  using dealii::Tensor;

  template <int dim>
  ElementFormulation<dim>::ElementFormulation(const ElasticMaterial &material)
    : c(material.elasticity(dim))
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
  typename ElementFormulation<dim>::template Gradients<
    ElementFormulation<dim>::n_vertices>
  ElementFormulation<dim>::unit_gradients(const dealii::Point<dim> &p)
  {
    Gradients<n_vertices> gradients;
    for (unsigned int v = 0; v < n_vertices; ++v)
      gradients[v] = GeometryInfo<dim>::d_linear_shape_function_gradient(p, v);
    return gradients;
  }

  template <int dim>
  Tensor<2, dim>
  ElementFormulation<dim>::jacobian(const Vertices              &vertices,
                                    const Gradients<n_vertices> &unit)
  {
    Tensor<2, dim> j;
    for (unsigned int v = 0; v < n_vertices; ++v)
      j += outer_product(vertices[v], unit[v]);
    return j;
  }

  template <int dim>
  typename ElementFormulation<dim>::StrainField
  ElementFormulation<dim>::d_linear(const Vertices &vertices,
                                    const bool      with_vertices) const
  {
    StrainField field;
    const auto  add = [&](const Gradients<n_vertices> &unit,
                         std::vector<Columns>        &strains) {
      const Tensor<2, dim>  j       = jacobian(vertices, unit);
      const Tensor<2, dim>  inverse = invert(j);
      Gradients<n_vertices> gradients;
      for (unsigned int v = 0; v < n_vertices; ++v)
        gradients[v] = unit[v] * inverse;
      strains.push_back(this->template strain_matrix<n_vertices>(gradients));
      return determinant(j);
    };
    for (unsigned int q = 0; q < at_points.size(); ++q)
      field.weights.push_back(unit_weights[q] *
                              add(at_points[q], field.at_points));
    if (with_vertices)
      for (const auto &unit : at_corners)
        add(unit, field.at_vertices);
    return field;
  }

  template <int dim>
  typename ElementFormulation<dim>::Matrix
  ElementFormulation<dim>::stiffness(const Vertices &vertices) const
  {
    StrainField b = d_linear(vertices, false);
    improve(vertices, b);
    Matrix k = Matrix::Zero();
    for (std::size_t q = 0; q < b.weights.size(); ++q)
      {
        const Eigen::Matrix<double, n_strains, n_dofs> of_dofs = b.at_points[q];
        const Eigen::Matrix<double, n_strains, n_dofs> stress =
          (b.weights[q] * c).lazyProduct(of_dofs);
        k += of_dofs.transpose().lazyProduct(stress);
      }
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }

  template <int dim>
  typename ElementFormulation<dim>::Displacements
  ElementFormulation<dim>::forces(const Vertices &vertices,
                                  const Strains  &initial) const
  {
    StrainField b = d_linear(vertices, false);
    improve(vertices, b);
    Displacements f = Displacements::Zero();
    for (std::size_t q = 0; q < b.weights.size(); ++q)
      f += b.at_points[q].transpose() *
           (b.weights[q] *
            (c * (initial * shapes.col(static_cast<Eigen::Index>(q)))));
    return f;
  }

  template <int dim>
  typename ElementFormulation<dim>::Strains
  ElementFormulation<dim>::stresses(const Vertices      &vertices,
                                    const Displacements &u,
                                    const Strains       &initial) const
  {
    StrainField strains = d_linear(vertices, true);
    for (std::size_t i = 0; i < n_vertices; ++i)
      {
        const auto column = static_cast<Eigen::Index>(i);
        strains.at_points[i] =
          (strains.at_points[i] * u - initial * shapes.col(column)).eval();
        strains.at_vertices[i] =
          (strains.at_vertices[i] * u - initial.col(column)).eval();
      }
    improve(vertices, strains);
    Strains result;
    for (std::size_t v = 0; v < n_vertices; ++v)
      result.col(static_cast<Eigen::Index>(v)) = c * strains.at_vertices[v];
    return result;
  }

  template class ElementFormulation<2>;
  template class ElementFormulation<3>;
} // namespace conetact
