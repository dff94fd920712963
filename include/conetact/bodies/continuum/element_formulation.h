// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_element_formulation_h
#define conetact_bodies_continuum_element_formulation_h

#include "conetact/bodies/continuum/material.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace conetact
{
  /**
   * How the strains @f$\bar B u@f$ of a cell with 2^dim vertices follow from
   * the displacements of these vertices, and from them its stiffness
   * @f$\int \bar B^T C \bar B\,dx@f$, by 2^dim Gauss points. Here
   * @f$\bar B@f$ is that of d-linear displacements (Q1); derived elements
   * improve it. Vertices come in deal.II's order, dof `dim * vertex +
   * component`; strains and stresses as in ElasticMaterial::elasticity().
   * Without the thickness of 2D bodies.
   */
  template <int dim>
  class ElementFormulation
  {
  public:
    static constexpr int n_vertices = 1 << dim;
    static constexpr int n_dofs     = dim * n_vertices;
    static constexpr int n_strains  = 2 * dim;

    using Vertices      = std::array<dealii::Point<dim>, n_vertices>;
    using Displacements = Eigen::Matrix<double, n_dofs, 1>;
    using Matrix        = Eigen::Matrix<double, n_dofs, n_dofs>;
    using Elasticity    = Eigen::Matrix<double, n_strains, n_strains>;
    /** A column for each vertex. */
    using Strains = Eigen::Matrix<double, n_strains, n_vertices>;

    explicit ElementFormulation(const ElasticMaterial &material);
    virtual ~ElementFormulation() = default;

    /** Exactly symmetric. */
    Matrix
    stiffness(const Vertices &vertices) const;
    /**
     * Nodal forces @f$\int \bar B^T C \varepsilon_0\,dx@f$ that would cause
     * strains of themselves, such as those of a change of temperature, given
     * at the vertices and d-linear between them.
     */
    Displacements
    forces(const Vertices &vertices, const Strains &initial) const;
    /** At the vertices, as this cell sees them, less those of `initial`. */
    Strains
    stresses(const Vertices      &vertices,
             const Displacements &u,
             const Strains       &initial) const;

  protected:
    /** Columns of strains, one or one for each dof. */
    using Columns =
      Eigen::Matrix<double, n_strains, Eigen::Dynamic, 0, n_strains, n_dofs>;
    /** Strains in a cell, those at vertices where they are asked for. */
    struct StrainField
    {
      std::vector<Columns> at_points, at_vertices;
      std::vector<double>  weights; ///< volumes of the Gauss points
    };
    template <int n>
    using Gradients = std::array<dealii::Tensor<1, dim>, n>;

    /** Turns strains of d-linear displacements into those of this element. */
    virtual void
    improve(const Vertices &, StrainField &) const
    {}

    /** @f$\partial x / \partial \xi@f$ at a point of the unit cell. */
    static dealii::Tensor<2, dim>
    jacobian(const Vertices &vertices, const Gradients<n_vertices> &unit);
    static Gradients<n_vertices>
    unit_gradients(const dealii::Point<dim> &p);

    /** Strains over the factors of n functions in each component. */
    template <int n>
    static Eigen::Matrix<double, n_strains, dim * n>
    strain_matrix(const Gradients<n> &gradients)
    {
      Eigen::Matrix<double, n_strains, dim *n> b =
        Eigen::Matrix<double, n_strains, dim * n>::Zero();
      for (int v = 0; v < n; ++v)
        {
          const dealii::Tensor<1, dim> &g =
            gradients[static_cast<std::size_t>(v)];
          for (int d = 0; d < dim; ++d)
            b(d, dim * v + d) = g[d];
          for (int row = 3; row < n_strains; ++row)
            {
              const int i = row - 3, j = (i + 1) % 3;
              b(row, dim * v + i) = g[j];
              b(row, dim * v + j) = g[i];
            }
        }
      return b;
    }

    const Elasticity                c;
    std::vector<dealii::Point<dim>> points, corners; ///< of the unit cell

  private:
    std::vector<Gradients<n_vertices>>            at_points, at_corners;
    std::vector<double>                           unit_weights;
    Eigen::Matrix<double, n_vertices, n_vertices> shapes; ///< column: a point

    /** Of d-linear displacements, a column for each dof. */
    StrainField
    d_linear(const Vertices &vertices, const bool with_vertices) const;
  };
} // namespace conetact

#endif
