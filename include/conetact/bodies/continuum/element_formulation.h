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

namespace conetact::bodies
{
  /**
   * How the strains @f$\bar B u@f$ of a cell follow from the displacements of
   * its nodes, and from them its stiffness
   * @f$\int \bar B^T C \bar B\,dx@f$. Nodes come in deal.II's order, vertices
   * first, dof `dim * node + component`; strains and stresses as in
   * ElasticMaterial::elasticity(). Without the thickness of 2D bodies;
   * of bodies of revolution, @f$dx = 2\pi r\,dA@f$ and
   * @f$\varepsilon_{zz} = u_r / r@f$, the whole circumference.
   */
  template <int dim>
  class ElementFormulation
  {
  public:
    static constexpr int n_strains = 2 * dim;

    using Vertices      = std::vector<dealii::Point<dim>>; ///< all nodes
    using Displacements = Eigen::VectorXd;
    using Matrix        = Eigen::MatrixXd;
    using Elasticity    = Eigen::Matrix<double, n_strains, n_strains>;
    /** A column for each node. */
    using Strains = Eigen::Matrix<double, n_strains, Eigen::Dynamic>;

    explicit ElementFormulation(const ElasticMaterial &material)
      : c(material.elasticity(dim))
      , is_ring(material.is_axisymmetric())
    {}
    virtual ~ElementFormulation() = default;

    /** Whether cells are rings round the y axis. */
    bool
    is_axisymmetric() const
    {
      return is_ring;
    }

    /** Exactly symmetric. */
    virtual Matrix
    stiffness(const Vertices &vertices) const = 0;
    /**
     * Nodal forces @f$\int \bar B^T C \varepsilon_0\,dx@f$ that would cause
     * strains of themselves, such as those of a change of temperature, given
     * at the nodes and interpolated between them.
     */
    virtual Displacements
    forces(const Vertices &vertices, const Strains &initial) const = 0;
    /** At the nodes, as this cell sees them, less those of `initial`. */
    virtual Strains
    stresses(const Vertices      &vertices,
             const Displacements &u,
             const Strains       &initial) const = 0;

  protected:
    template <int n>
    using Gradients = std::array<dealii::Tensor<1, dim>, n>;

    /**
     * Completes the strains of a ring whose n nodes have shape values N at
     * the radius r = sum N_v x_v: zz is u_r / r, and du_r / dr on the axis,
     * the limit. Nodes on the axis have no u_r.
     */
    template <int n, class Shapes>
    void
    go_round(const Vertices                            &vertices,
             const Shapes                              &N,
             const double                               r,
             Eigen::Matrix<double, n_strains, dim * n> &b) const
    {
      for (int v = 0; v < n; ++v)
        if (vertices[static_cast<std::size_t>(v)][0] > 0)
          b(2, dim * v) = r > 0 ? N[v] / r : b(0, dim * v);
        else
          b.col(dim * v).setZero();
    }

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

    const Elasticity c;
    const bool       is_ring;
  };

  /**
   * Of quadrilaterals and hexahedra, with 2^dim Gauss points. Here
   * @f$\bar B@f$ is that of d-linear displacements (Q1); derived elements
   * improve it.
   */
  template <int dim>
  class DLinearElement : public ElementFormulation<dim>
  {
  public:
    using Base = ElementFormulation<dim>;
    using typename Base::Displacements;
    using typename Base::Matrix;
    using typename Base::Strains;
    using typename Base::Vertices;
    static constexpr int n_vertices = 1 << dim;
    static constexpr int n_dofs     = dim * n_vertices;
    static constexpr int n_strains  = Base::n_strains;

    explicit DLinearElement(const ElasticMaterial &material);

    Matrix
    stiffness(const Vertices &vertices) const override;
    Displacements
    forces(const Vertices &vertices, const Strains &initial) const override;
    Strains
    stresses(const Vertices      &vertices,
             const Displacements &u,
             const Strains       &initial) const override;

  protected:
    template <int n>
    using Gradients = typename Base::template Gradients<n>;
    /** Columns of strains, one or one for each dof. */
    using Columns =
      Eigen::Matrix<double, n_strains, Eigen::Dynamic, 0, n_strains, n_dofs>;
    /** Strains in a cell, those at vertices where they are asked for. */
    struct StrainField
    {
      std::vector<Columns> at_points, at_vertices;
      std::vector<double>  weights; ///< volumes of the Gauss points
    };

    /** Turns strains of d-linear displacements into those of this element. */
    virtual void
    improve(const Vertices &, StrainField &) const
    {}

    /** @f$\partial x / \partial \xi@f$ at a point of the unit cell. */
    static dealii::Tensor<2, dim>
    jacobian(const Vertices &vertices, const Gradients<n_vertices> &unit);
    static Gradients<n_vertices>
    unit_gradients(const dealii::Point<dim> &p);

    std::vector<dealii::Point<dim>> points, corners; ///< of the unit cell

  private:
    std::vector<Gradients<n_vertices>>            at_points, at_corners;
    std::vector<double>                           unit_weights;
    Eigen::Matrix<double, n_vertices, n_vertices> shapes; ///< column: a point

    /** Of d-linear displacements, a column for each dof. */
    StrainField
    d_linear(const Vertices &vertices, const bool with_vertices) const;
  };

  /**
   * Of triangles and tetrahedra: linear displacements, uniform strains but
   * round an axis.
   */
  template <int dim>
  class LinearElement : public ElementFormulation<dim>
  {
  public:
    using Base = ElementFormulation<dim>;
    using typename Base::Displacements;
    using typename Base::Matrix;
    using typename Base::Strains;
    using typename Base::Vertices;
    static constexpr int n_vertices = dim + 1;
    static constexpr int n_dofs     = dim * n_vertices;
    static constexpr int n_strains  = Base::n_strains;
    using Base::Base;

    Matrix
    stiffness(const Vertices &vertices) const override;
    Displacements
    forces(const Vertices &vertices, const Strains &initial) const override;
    Strains
    stresses(const Vertices      &vertices,
             const Displacements &u,
             const Strains       &initial) const override;

  private:
    /** Strains over the dofs at a point of the cell, and its volume. */
    struct PointOfCell
    {
      Eigen::Matrix<double, n_strains, n_dofs> b;
      Eigen::Matrix<double, n_vertices, 1>     shapes;
      double                                   volume;
    };
    /** Of those with the rows of shape values: one, three of a ring. */
    std::vector<PointOfCell>
    points(const Vertices &vertices) const;
    /** At its vertices. */
    std::vector<PointOfCell>
    corners(const Vertices &vertices) const;
    std::vector<PointOfCell>
    at(const Vertices &vertices, const Eigen::MatrixXd &shapes) const;
  };
} // namespace conetact::bodies

#endif
