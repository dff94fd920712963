// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_material_h
#define conetact_bodies_continuum_material_h

#include <deal.II/base/parameter_handler.h>

#include <Eigen/Core>

#include <string>

namespace conetact::bodies
{
  /**
   * Isotropic linear elasticity,
   * @f$\sigma = \lambda\,\mathrm{tr}\,\varepsilon\,I + 2 G \varepsilon@f$.
   */
  struct ElasticMaterial
  {
    enum class Plane
    {
      strain,
      stress
    };

    double young_modulus = 1;             ///< E [force/length^2]
    double poisson_ratio = .3;            ///< nu
    Plane  plane         = Plane::strain; ///< 2D only
    double thickness     = 1;             ///< 2D only [length]
    double expansion     = 0;             ///< alpha [1/K]

    /**
     * Elasticity matrix of stresses over strains in the order xx, yy, zz, xy
     * and, in 3D, yz, zx; shear strains are the engineers' (twice the tensor's
     * components). In plane stress zz takes no part.
     */
    Eigen::MatrixXd
    elasticity(const unsigned int dim) const;

    /** Strain that 1 K causes where nothing resists, in that order. */
    Eigen::VectorXd
    thermal_strain(const unsigned int dim) const;
  };

  /** Entries of `subsection Material`, in the body's subsection. */
  void
  declare_material(dealii::ParameterHandler &prm);
  /** `body` is for messages: "Body 'block'". Throws InputError. */
  ElasticMaterial
  parse_material(dealii::ParameterHandler &prm, const std::string &body);
} // namespace conetact::bodies

#endif
