// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/element_formulation.h"

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

namespace conetact::bodies
{
  using dealii::FEValues;
  using dealii::Tensor;

  template <int dim>
  ElementFormulation<dim>::ElementFormulation(
    const ElasticMaterial            &material,
    const dealii::FiniteElement<dim> &fe,
    const dealii::Quadrature<dim>    &quadrature)
    : c(material.elasticity(dim))
    , is_ring(material.is_axisymmetric())
    , mapping(fe)
    , points(mapping,
             mapping.element(),
             quadrature,
             dealii::update_values | dealii::update_gradients |
               dealii::update_jacobians | dealii::update_quadrature_points)
    , nodes(mapping,
            mapping.element(),
            dealii::Quadrature<dim>(fe.get_unit_support_points()),
            points.get_update_flags())
  {
    AssertIndexRange(dim * fe.n_dofs_per_cell(), most_dofs + 1);
  }

  /**
   * The strains of a ring are completed: zz is u_r / r, and du_r / dr on the
   * axis, the limit. Nodes on the axis have no u_r.
   */
  template <int dim>
  void
  ElementFormulation<dim>::add_strains(const Vertices       &vertices,
                                       const FEValues<dim>  &fe_values,
                                       std::vector<Columns> &strains) const
  {
    strains.reserve(strains.size() + fe_values.n_quadrature_points);
    for (const unsigned int q : fe_values.quadrature_point_indices())
      {
        Columns &b = strains.emplace_back(
          strain_matrix(fe_values.dofs_per_cell, [&](const unsigned int v) {
            return fe_values.shape_grad(v, q);
          }));
        if (!is_ring)
          continue;
        const double r = fe_values.quadrature_point(q)[0];
        for (const unsigned int v : fe_values.dof_indices())
          if (vertices[v][0] > 0)
            b(2, dim * v) =
              r > 0 ? fe_values.shape_value(v, q) / r : b(0, dim * v);
          else
            b.col(dim * v).setZero();
      }
  }

  template <int dim>
  typename ElementFormulation<dim>::StrainField
  ElementFormulation<dim>::strains_at_points(const Vertices &vertices) const
  {
    points.reinit(mapping.cell_at(vertices));
    StrainField field;
    add_strains(vertices, points, field.at_points);
    for (const unsigned int q : points.quadrature_point_indices())
      {
        // JxW would stop a Debug build at cells that are folded, for which
        // users get a sentence.
        const double dx =
          points.get_quadrature().weight(q) * points.jacobian(q).determinant();
        // of the cell along what the mesh does not show
        const double size =
          is_ring ? 2 * dealii::numbers::PI * points.quadrature_point(q)[0] :
                    1.;
        field.weights.push_back(size * dx);
      }
    return field;
  }

  namespace
  {
    /** k += b^T stress in blocks of that size, those on and below the diagonal:
     * products of matrices this small are faster entry by entry. */
    template <int part, class Columns>
    void
    add_products(const Columns &b, const Columns &stress, Eigen::MatrixXd &k)
    {
      AssertDimension(k.cols() % part, 0);
      for (Eigen::Index j = 0; j < k.cols(); j += part)
        for (Eigen::Index i = j; i < k.rows(); i += part)
          k.template block<part, part>(i, j) +=
            b.template middleCols<part>(i).transpose().lazyProduct(
              stress.template middleCols<part>(j));
    }
  } // namespace

  template <int dim>
  typename ElementFormulation<dim>::Matrix
  ElementFormulation<dim>::stiffness(const Vertices &vertices) const
  {
    StrainField b = strains_at_points(vertices);
    // K = int B^T C B with the strains that the element has improved.
    improve(vertices, b);
    const auto n = static_cast<Eigen::Index>(dim * vertices.size());
    Matrix     k = Matrix::Zero(n, n);
    for (std::size_t q = 0; q < b.weights.size(); ++q)
      {
        const Columns stress = (b.weights[q] * c).lazyProduct(b.at_points[q]);
        // Elements have multiples of two or of three nodes.
        if (vertices.size() % 2 == 0)
          add_products<2 * dim>(b.at_points[q], stress, k);
        else
          add_products<3 * dim>(b.at_points[q], stress, k);
      }
    // Half of it copied: symmetric to the last bit.
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }

  template <int dim>
  typename ElementFormulation<dim>::Strain
  ElementFormulation<dim>::at_point(const Strains     &of_nodes,
                                    const unsigned int q) const
  {
    Strain sum = Strain::Zero();
    for (const unsigned int v : points.dof_indices())
      sum += points.shape_value(v, q) * of_nodes.col(v);
    return sum;
  }

  template <int dim>
  typename ElementFormulation<dim>::Displacements
  ElementFormulation<dim>::forces(const Vertices &vertices,
                                  const Strains  &initial) const
  {
    StrainField b = strains_at_points(vertices);
    improve(vertices, b);
    Displacements f = Displacements::Zero(b.at_points.front().cols());
    for (const unsigned int q : points.quadrature_point_indices())
      f += b.at_points[q].transpose() *
           (b.weights[q] * (c * at_point(initial, q)));
    return f;
  }

  /* Stresses are those of the nodes themselves, not continued from the points.
     Initial strains are taken off before the element improves the rest: it is
     stress that internal modes answer to. */
  template <int dim>
  typename ElementFormulation<dim>::Strains
  ElementFormulation<dim>::stresses(const Vertices      &vertices,
                                    const Displacements &u,
                                    const Strains       &initial) const
  {
    StrainField strains;
    if (is_improved())
      {
        strains = strains_at_points(vertices);
        for (const unsigned int q : points.quadrature_point_indices())
          strains.at_points[q] =
            (strains.at_points[q] * u - at_point(initial, q)).eval();
      }
    nodes.reinit(mapping.cell_at(vertices));
    add_strains(vertices, nodes, strains.at_vertices);
    for (const unsigned int v : nodes.dof_indices())
      strains.at_vertices[v] =
        (strains.at_vertices[v] * u - initial.col(v)).eval();
    improve(vertices, strains);
    Strains result(n_strains, vertices.size());
    for (const unsigned int v : nodes.dof_indices())
      result.col(v) = c * strains.at_vertices[v];
    return result;
  }



  template <int dim>
  DLinearElement<dim>::DLinearElement(const ElasticMaterial &material)
    : ElementFormulation<dim>(material,
                              dealii::FE_Q<dim>(1),
                              dealii::QGauss<dim>(2))
  {}

  template class ElementFormulation<2>;
  template class ElementFormulation<3>;
  template class DLinearElement<2>;
  template class DLinearElement<3>;
} // namespace conetact::bodies
