// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_quadratic_element_h
#define conetact_bodies_continuum_quadratic_element_h

#include "conetact/bodies/continuum/element_formulation.h"

#include <vector>

namespace conetact::bodies
{
  /**
   * Of displacements of second degree: biquadratic and triquadratic on
   * quadrilaterals and hexahedra (FE_Q), quadratic on triangles and tetrahedra
   * (FE_SimplexP).
   * Positions are interpolated as displacements are, so that uniform strains
   * are exact however nodes stand. Not round an axis.
   */
  template <int dim>
  class QuadraticElement : public ElementFormulation<dim>
  {
  public:
    using Base = ElementFormulation<dim>;
    using typename Base::Displacements;
    using typename Base::Matrix;
    using typename Base::Strains;
    using typename Base::Vertices;
    static constexpr int n_strains = Base::n_strains;

    QuadraticElement(const ElasticMaterial &material, const bool is_simplex);

    Matrix
    stiffness(const Vertices &nodes) const override;
    Displacements
    forces(const Vertices &nodes, const Strains &initial) const override;
    Strains
    stresses(const Vertices      &nodes,
             const Displacements &u,
             const Strains       &initial) const override;

  private:
    /** A point of the unit cell: shape functions and their gradients there. */
    struct UnitPoint
    {
      Eigen::VectorXd                     shapes;
      std::vector<dealii::Tensor<1, dim>> gradients;
      double                              weight;
    };
    /** Strains over the dofs at a point, and the volume it stands for. */
    struct PointOfCell
    {
      Eigen::Matrix<double, n_strains, Eigen::Dynamic> b;
      double                                           volume;
    };
    PointOfCell
    at(const Vertices &nodes, const UnitPoint &point) const;

    std::vector<UnitPoint> gauss, at_nodes;
  };
} // namespace conetact::bodies

#endif
