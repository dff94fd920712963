// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_structures_continuum_elements_h
#define conetact_structures_continuum_elements_h

#include <deal.II/base/point.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace conetact
{
  /**
   * How the strains of a cell with 2^dim vertices follow from the
   * displacements of these vertices, and its stiffness
   * @f$\int B^T C B\,dx@f$ from the strains. Vertices come in deal.II's order,
   * dof `dim * vertex + component`; strains as in
   * ElasticMaterial::elasticity(). Without the thickness of 2D bodies.
   */
  template <int dim>
  class ElementFormulation
  {
  public:
    static constexpr int n_vertices = 1 << dim;
    static constexpr int n_dofs     = dim * n_vertices;
    static constexpr int n_strains  = dim * (dim + 1) / 2;

    using Vertices      = std::array<dealii::Point<dim>, n_vertices>;
    using Displacements = Eigen::Matrix<double, n_dofs, 1>;
    using Matrix        = Eigen::Matrix<double, n_dofs, n_dofs>;
    using Elasticity    = Eigen::Matrix<double, n_strains, n_strains>;
    /** A column for each vertex. */
    using Strains = Eigen::Matrix<double, n_strains, n_vertices>;

    virtual ~ElementFormulation() = default;

    /** Exactly symmetric. */
    virtual Matrix
    stiffness(const Vertices &vertices, const Elasticity &c) const = 0;
    /**
     * Nodal forces @f$\int B^T \sigma\,dx@f$ of stresses that are given at the
     * vertices and d-linear between them.
     */
    virtual Displacements
    forces(const Vertices &vertices, const Strains &stresses) const = 0;
    /** At the vertices, as this cell sees them. */
    virtual Strains
    strains(const Vertices &vertices, const Displacements &u) const = 0;
  };

  /** One row for each kind of element. */
  template <int dim>
  struct ElementRow
  {
    const char *name;
    const char *description;
    std::unique_ptr<ElementFormulation<dim>> (*create)();
  };
  template <int dim>
  const std::vector<ElementRow<dim>> &
  element_table();
} // namespace conetact

#endif
