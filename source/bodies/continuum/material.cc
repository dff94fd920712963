// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/material.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

namespace conetact::bodies
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    void
    check(const ElasticMaterial &material, const std::string &where)
    {
      if (!(material.young_modulus > 0))
        throw InputError(where +
                         "Young modulus: " + to_text(material.young_modulus) +
                         " is not positive. Give a stiffness above 0.");
      if (!(material.poisson_ratio < .5))
        throw InputError(where +
                         "Poisson ratio: " + to_text(material.poisson_ratio) +
                         " is incompressible or beyond, which displacements " +
                         "alone cannot represent. Give a value below 0.5, " +
                         "such as 0.499.");
      if (!(material.poisson_ratio > -1))
        throw InputError(where +
                         "Poisson ratio: " + to_text(material.poisson_ratio) +
                         " is not above -1. Give a value between -1 and 0.5.");
      if (!(material.thickness > 0))
        throw InputError(where + "Thickness: " + to_text(material.thickness) +
                         " is not positive. Give a length above 0.");
    }
  } // namespace

  Eigen::MatrixXd
  ElasticMaterial::elasticity(const unsigned int dim) const
  {
    const bool         free  = dim == 2 && plane == Plane::stress;
    const Eigen::Index n     = free ? 2 : 3; // axes with stress
    const double       shear = young_modulus / (2 * (1 + poisson_ratio));
    // With sigma_zz = 0 the strain along z is eliminated: nu / (1 - nu^2) takes
    // the place of nu / ((1 + nu) (1 - 2 nu)).
    const double lame =
      free ?
        young_modulus * poisson_ratio / (1 - poisson_ratio * poisson_ratio) :
        2 * shear * poisson_ratio / (1 - 2 * poisson_ratio);

    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(2 * dim, 2 * dim);
    c.topLeftCorner(n, n).setConstant(lame);
    c.diagonal().head(n).array() += 2 * shear;
    // G, not 2 G, for the engineers' shear strains.
    c.diagonal().tail(2 * dim - 3).setConstant(shear);
    return c;
  }

  Eigen::VectorXd
  ElasticMaterial::thermal_strain(const unsigned int dim) const
  {
    Eigen::VectorXd strain = Eigen::VectorXd::Zero(2 * dim);
    // Along z, too: in plane strain heat presses against what holds the body
    // there.
    strain.head<3>().setConstant(expansion);
    return strain;
  }

  void
  declare_material(ParameterHandler &prm)
  {
    prm.enter_subsection("Material");
    prm.declare_entry("Young modulus",
                      "",
                      Patterns::Anything(),
                      "Young's modulus E, above 0; must be given. A number or "
                      "a constant expression such as 210e3. "
                      "[force/length^2]");
    prm.declare_entry(
      "Poisson ratio",
      "",
      Patterns::Anything(),
      "Poisson's ratio nu, between -1 and 0.5; must be given. "
      "Near 0.5 the elements Q1 become too stiff (locking); see "
      "Element. [-]");
    prm.declare_entry("Plane",
                      "strain",
                      Patterns::Selection("strain|stress"),
                      "2D only: plane strain (no strain along z, a long body) "
                      "or plane stress (no stress along z, a thin plate). [-]");
    prm.declare_entry("Thickness",
                      "1",
                      Patterns::Anything(),
                      "2D only: extent of the body along z, above 0. All "
                      "forces of the body are those on this thickness. "
                      "[length]");
    prm.declare_entry("Expansion coefficient",
                      "0",
                      Patterns::Anything(),
                      "Thermal expansion alpha: strain of a change of "
                      "temperature by 1 K where nothing resists. [1/K]");
    prm.leave_subsection();
  }

  ElasticMaterial
  parse_material(ParameterHandler &prm, const std::string &body)
  {
    const std::string where = body + ", Material/";
    ElasticMaterial   material;
    prm.enter_subsection("Material");
    material.young_modulus =
      to_number(prm.get("Young modulus"), where + "Young modulus");
    material.poisson_ratio =
      to_number(prm.get("Poisson ratio"), where + "Poisson ratio");
    material.plane     = prm.get("Plane") == "strain" ?
                           ElasticMaterial::Plane::strain :
                           ElasticMaterial::Plane::stress;
    material.thickness = to_number(prm.get("Thickness"), where + "Thickness");
    material.expansion = to_number(prm.get("Expansion coefficient"),
                                   where + "Expansion coefficient");
    prm.leave_subsection();
    check(material, where);
    return material;
  }
} // namespace conetact::bodies
