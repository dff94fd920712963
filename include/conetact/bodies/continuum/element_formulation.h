// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_element_formulation_h
#define conetact_bodies_continuum_element_formulation_h

#include "conetact/bodies/continuum/material.h"
#include "conetact/bodies/continuum/node_mapping.h"

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/Core>

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
   *
   * Here @f$\bar B@f$ is that of the displacements themselves; derived elements
   * improve it. An object computes one cell at a time: not for several threads.
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

    /** Of displacements with the shape functions of a scalar element. */
    ElementFormulation(const ElasticMaterial            &material,
                       const dealii::FiniteElement<dim> &fe,
                       const dealii::Quadrature<dim>    &quadrature);
    virtual ~ElementFormulation() = default;

    /** Whether cells are rings round the y axis. */
    bool
    is_axisymmetric() const
    {
      return is_ring;
    }

    /** Exactly symmetric. */
    virtual Matrix
    stiffness(const Vertices &vertices) const;
    /**
     * Nodal forces @f$\int \bar B^T C \varepsilon_0\,dx@f$ that would cause
     * strains of themselves, such as those of a change of temperature, given
     * at the nodes and interpolated between them.
     */
    Displacements
    forces(const Vertices &vertices, const Strains &initial) const;
    /** At the nodes, as this cell sees them, less those of `initial`. */
    Strains
    stresses(const Vertices      &vertices,
             const Displacements &u,
             const Strains       &initial) const;

  protected:
    /** Columns of strains, one or one for each dof; cells of the second degree
     * have 3^dim nodes at most. */
    static constexpr int most_dofs = dim == 2 ? 18 : 81;
    using Columns =
      Eigen::Matrix<double, n_strains, Eigen::Dynamic, 0, n_strains, most_dofs>;
    /** Strains in a cell, those at nodes where they are asked for. */
    struct StrainField
    {
      std::vector<Columns> at_points, at_vertices;
      std::vector<double>  weights; ///< volumes of the Gauss points
    };

    /** Turns strains of the displacements into those of this element. */
    virtual void
    improve(const Vertices &, StrainField &) const
    {}
    /** Whether it does: strains at nodes may depend on those at points. */
    virtual bool
    is_improved() const
    {
      return false;
    }

    /** Strains over the factors of n functions in each component, of their
     * gradients in space. */
    template <class Gradient>
    static Columns
    strain_matrix(const unsigned int n, const Gradient &gradient)
    {
      Columns b = Columns::Zero(n_strains, dim * n);
      for (unsigned int v = 0; v < n; ++v)
        {
          const dealii::Tensor<1, dim> g = gradient(v);
          for (unsigned int d = 0; d < dim; ++d)
            b(d, dim * v + d) = g[d];
          for (unsigned int row = 3; row < n_strains; ++row)
            {
              const unsigned int i = row - 3, j = (i + 1) % 3;
              b(row, dim * v + i) = g[j];
              b(row, dim * v + j) = g[i];
            }
        }
      return b;
    }

    const Elasticity              c;
    const bool                    is_ring;
    mutable NodeMapping<dim>      mapping;
    mutable dealii::FEValues<dim> points, nodes; ///< of the cell at hand

  private:
    void
    add_strains(const Vertices              &vertices,
                const dealii::FEValues<dim> &fe_values,
                std::vector<Columns>        &strains) const;
    StrainField
    strains_at_points(const Vertices &vertices) const;
    using Strain = Eigen::Matrix<double, n_strains, 1>;
    Strain
    at_point(const Strains &of_nodes, const unsigned int q) const;
  };

  /** Of quadrilaterals and hexahedra, with 2^dim Gauss points (Q1). */
  template <int dim>
  class DLinearElement : public ElementFormulation<dim>
  {
  public:
    explicit DLinearElement(const ElasticMaterial &material);
  };
} // namespace conetact::bodies

#endif
