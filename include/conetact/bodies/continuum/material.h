// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_material_h
#define conetact_bodies_continuum_material_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /**
   * Orthotropic linear elasticity along three axes 1, 2, 3 of the material:
   * @f$\varepsilon_{11} = \sigma_{11}/E_1 - \nu_{12}\sigma_{22}/E_1 -
   * \nu_{13}\sigma_{33}/E_1@f$ and so on, with
   * @f$\nu_{ij}/E_i = \nu_{ji}/E_j@f$, and @f$\gamma_{12} =
   * \sigma_{12}/G_{12}@f$.
   */
  struct Orthotropy
  {
    Eigen::Vector3d young;   ///< E_1, E_2, E_3 [force/length^2]
    Eigen::Vector3d poisson; ///< nu_12, nu_13, nu_23
    Eigen::Vector3d shear;   ///< G_12, G_13, G_23 [force/length^2]
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< columns, scene's

    /**
     * Strains over stresses in the scene's axes, xx, yy, zz, xy, yz, zx with
     * the engineers' shear strains.
     */
    Eigen::MatrixXd
    compliance() const;
  };

  /**
   * Linear elasticity, isotropic,
   * @f$\sigma = \lambda\,\mathrm{tr}\,\varepsilon\,I + 2 G \varepsilon@f$,
   * or orthotropic.
   */
  struct ElasticMaterial
  {
    enum class Plane
    {
      strain,
      stress,
      axisymmetric ///< x is the radius, zz goes round the axis
    };

    double                    young_modulus = 1;  ///< E [force/length^2]
    double                    poisson_ratio = .3; ///< nu
    Plane                     plane         = Plane::strain; ///< 2D only
    double                    thickness     = 1; ///< 2D only [length]
    double                    expansion     = 0; ///< alpha [1/K]
    std::optional<Orthotropy> orthotropy;        ///< instead of E and nu

    bool
    is_axisymmetric() const
    {
      return plane == Plane::axisymmetric;
    }

    /**
     * Elasticity matrix of stresses over strains in the order xx, yy, zz, xy
     * and, in 3D, yz, zx; shear strains are the engineers' (twice the tensor's
     * components). In plane stress zz takes no part.
     */
    Eigen::MatrixXd
    elasticity(const unsigned int dim) const;

    /** Structure::contrast_of_strains() */
    double
    contrast_of_strains() const;

    /** The largest modulus [force/length^2]. */
    double
    stiffness() const
    {
      return orthotropy ? orthotropy->young.maxCoeff() : young_modulus;
    }
  };

  /** Components of a strain in that order. */
  Eigen::VectorXd
  strain_components(const dealii::Tensor<2, 3> &strain, const unsigned int dim);

  /** What the cells of some groups are made of. */
  struct MaterialOfGroups
  {
    std::string     groups; ///< names or numbers; empty: all cells
    ElasticMaterial material;
  };

  /** Entries of `subsection Material`, in the body's subsection. */
  void
  declare_material(dealii::ParameterHandler &prm);
  /**
   * One material, or one for each Material group. `body` is for messages:
   * "Body 'block'". Throws InputError.
   */
  std::vector<MaterialOfGroups>
  parse_materials(dealii::ParameterHandler &prm,
                  const unsigned int        dim,
                  const std::string        &body);
} // namespace conetact::bodies

#endif
