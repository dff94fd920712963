// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/quadratic_element.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <memory>

namespace conetact::bodies
{
  using dealii::Point;
  using dealii::Tensor;

  template <int dim>
  QuadraticElement<dim>::QuadraticElement(const ElasticMaterial &material,
                                          const bool             is_simplex)
    : Base(material)
  {
    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    dealii::Quadrature<dim>                     rule;
    if (is_simplex)
      {
        fe   = std::make_unique<dealii::FE_SimplexP<dim>>(2);
        rule = dealii::QGaussSimplex<dim>(3);
      }
    else
      {
        fe   = std::make_unique<dealii::FE_Q<dim>>(2);
        rule = dealii::QGauss<dim>(3);
      }
    const auto add = [&](const Point<dim>       &p,
                         const double            weight,
                         std::vector<UnitPoint> &points) {
      const unsigned int n = fe->dofs_per_cell;
      UnitPoint          point{Eigen::VectorXd(n), {}, weight};
      for (unsigned int v = 0; v < n; ++v)
        {
          point.shapes[v] = fe->shape_value(v, p);
          point.gradients.push_back(fe->shape_grad(v, p));
        }
      points.push_back(point);
    };
    for (unsigned int q = 0; q < rule.size(); ++q)
      add(rule.point(q), rule.weight(q), gauss);
    for (const Point<dim> &p : fe->get_unit_support_points())
      add(p, 0, at_nodes);
  }

  template <int dim>
  typename QuadraticElement<dim>::PointOfCell
  QuadraticElement<dim>::at(const Vertices &nodes, const UnitPoint &point) const
  {
    Tensor<2, dim> jacobian; // dx/dxi
    for (std::size_t v = 0; v < nodes.size(); ++v)
      jacobian += outer_product(nodes[v], point.gradients[v]);
    const Tensor<2, dim> inverse = invert(jacobian);
    const auto           n       = static_cast<Eigen::Index>(nodes.size());
    PointOfCell          result{Eigen::MatrixXd::Zero(n_strains, dim * n),
                       point.weight * determinant(jacobian)};
    for (Eigen::Index v = 0; v < n; ++v)
      result.b.template middleCols<dim>(dim * v) =
        this->template strain_matrix<1>(
          {{point.gradients[static_cast<std::size_t>(v)] * inverse}});
    return result;
  }

  template <int dim>
  typename QuadraticElement<dim>::Matrix
  QuadraticElement<dim>::stiffness(const Vertices &nodes) const
  {
    const auto n = static_cast<Eigen::Index>(dim * nodes.size());
    Matrix     k = Matrix::Zero(n, n);
    for (const UnitPoint &point : gauss)
      {
        const PointOfCell p = at(nodes, point);
        k.noalias() += p.b.transpose() * (p.volume * this->c * p.b);
      }
    // Half of it copied: symmetric to the last bit.
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }

  template <int dim>
  typename QuadraticElement<dim>::Displacements
  QuadraticElement<dim>::forces(const Vertices &nodes,
                                const Strains  &initial) const
  {
    Displacements f =
      Displacements::Zero(static_cast<Eigen::Index>(dim * nodes.size()));
    for (const UnitPoint &point : gauss)
      {
        const PointOfCell p = at(nodes, point);
        f += p.b.transpose() * (p.volume * this->c * (initial * point.shapes));
      }
    return f;
  }

  template <int dim>
  typename QuadraticElement<dim>::Strains
  QuadraticElement<dim>::stresses(const Vertices      &nodes,
                                  const Displacements &u,
                                  const Strains       &initial) const
  {
    Strains result(n_strains, static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t v = 0; v < nodes.size(); ++v)
      {
        const auto column = static_cast<Eigen::Index>(v);
        result.col(column) =
          this->c * (at(nodes, at_nodes[v]).b * u - initial.col(column));
      }
    return result;
  }

  template class QuadraticElement<2>;
  template class QuadraticElement<3>;
} // namespace conetact::bodies
