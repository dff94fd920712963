// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/structures/continuum_elements.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

namespace conetact
{
  using dealii::GeometryInfo;
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Gradients of the vertices' shape functions in the unit cell. */
    template <int dim>
    using Gradients = std::array<Tensor<1, dim>, (1 << dim)>;

    template <int dim>
    Gradients<dim>
    unit_gradients(const Point<dim> &p)
    {
      Gradients<dim> gradients;
      for (unsigned int v = 0; v < gradients.size(); ++v)
        gradients[v] =
          GeometryInfo<dim>::d_linear_shape_function_gradient(p, v);
      return gradients;
    }

    /**
     * Full integration of the d-linear displacements with 2^dim Gauss points:
     * simple, never unstable; too stiff in bending and near nu = 0.5.
     */
    template <int dim>
    class Q1 : public ElementFormulation<dim>
    {
    public:
      using Base = ElementFormulation<dim>;
      using typename Base::Displacements;
      using typename Base::Elasticity;
      using typename Base::Matrix;
      using typename Base::Strains;
      using typename Base::Vertices;
      using StrainMatrix = Eigen::Matrix<double, Base::n_strains, Base::n_dofs>;

      Q1()
      {
        const dealii::QGauss<dim> gauss(2);
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            at_points.push_back(unit_gradients(gauss.point(q)));
            for (unsigned int v = 0; v < Base::n_vertices; ++v)
              shapes(v, q) =
                GeometryInfo<dim>::d_linear_shape_function(gauss.point(q), v);
            weights.push_back(gauss.weight(q));
          }
        for (unsigned int v = 0; v < Base::n_vertices; ++v)
          at_vertices[v] =
            unit_gradients(GeometryInfo<dim>::unit_cell_vertex(v));
      }

      Matrix
      stiffness(const Vertices &vertices, const Elasticity &c) const override
      {
        Matrix k = Matrix::Zero();
        for (unsigned int q = 0; q < at_points.size(); ++q)
          {
            StrainMatrix b;
            const double w =
              weights[q] * strain_matrix(at_points[q], vertices, b);
            const StrainMatrix s = (w * c).lazyProduct(b);
            k += b.transpose().lazyProduct(s);
          }
        k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
        return k;
      }

      Displacements
      forces(const Vertices &vertices, const Strains &stresses) const override
      {
        Displacements f = Displacements::Zero();
        StrainMatrix  b;
        for (unsigned int q = 0; q < at_points.size(); ++q)
          {
            const double w =
              weights[q] * strain_matrix(at_points[q], vertices, b);
            f += b.transpose() * (w * (stresses * shapes.col(q)));
          }
        return f;
      }

      Strains
      strains(const Vertices &vertices, const Displacements &u) const override
      {
        Strains      strains;
        StrainMatrix b;
        for (unsigned int v = 0; v < Base::n_vertices; ++v)
          {
            strain_matrix(at_vertices[v], vertices, b);
            strains.col(v) = b * u;
          }
        return strains;
      }

    private:
      std::vector<Gradients<dim>>                               at_points;
      std::vector<double>                                       weights;
      Eigen::Matrix<double, Base::n_vertices, Base::n_vertices> shapes;
      std::array<Gradients<dim>, Base::n_vertices>              at_vertices;

      /** Strains over displacements; returns the Jacobian's determinant. */
      static double
      strain_matrix(const Gradients<dim> &unit,
                    const Vertices       &vertices,
                    StrainMatrix         &b)
      {
        Tensor<2, dim> jacobian;
        for (unsigned int v = 0; v < Base::n_vertices; ++v)
          jacobian += outer_product(vertices[v], unit[v]);
        const Tensor<2, dim> inverse = invert(jacobian);

        b.setZero();
        for (unsigned int v = 0; v < Base::n_vertices; ++v)
          {
            const Tensor<1, dim> g = unit[v] * inverse;
            for (int d = 0; d < dim; ++d)
              b(d, dim * v + d) = g[d];
            for (int row = dim; row < Base::n_strains; ++row)
              {
                const int i = row - dim, j = (i + 1) % dim;
                b(row, dim * v + i) = g[j];
                b(row, dim * v + j) = g[i];
              }
          }
        return determinant(jacobian);
      }
    };

    template <int dim>
    std::unique_ptr<ElementFormulation<dim>>
    create_q1()
    {
      return std::make_unique<Q1<dim>>();
    }
  } // namespace

  template <int dim>
  const std::vector<ElementRow<dim>> &
  element_table()
  {
    static const std::vector<ElementRow<dim>> table = {
      {"Q1", "bi- or trilinear displacements, full integration", &create_q1}};
    return table;
  }

  template const std::vector<ElementRow<2>> &
  element_table<2>();
  template const std::vector<ElementRow<3>> &
  element_table<3>();
} // namespace conetact
