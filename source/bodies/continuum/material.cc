// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/material.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/placement.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

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
      if (material.young_modulus < 1e-100) // products of it would be 0
        throw InputError(where +
                         "Young modulus: " + to_text(material.young_modulus) +
                         " is too small to compute with. Choose other units.");
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
      if (material.is_axisymmetric() && material.thickness != 1)
        throw InputError(where + "Thickness: a body of revolution (Plane = "
                                 "axisymmetric) has none, its forces are those "
                                 "of the whole circumference. Remove it.");
    }

    ElasticMaterial::Plane
    plane_of(const std::string &text)
    {
      using Plane = ElasticMaterial::Plane;
      return text == "strain" ? Plane::strain :
             text == "stress" ? Plane::stress :
                                Plane::axisymmetric;
    }

    /** One of each of n materials, or one of all, as texts. */
    std::vector<std::string>
    entries(const ParameterHandler &prm,
            const std::string      &name,
            const std::size_t       n,
            const std::string      &where)
    {
      std::vector<std::string> result = split(prm.get(name), ';');
      if (result.empty()) // whoever reads it says that it is missing
        result.push_back(prm.get(name));
      if (result.size() == 1)
        result.resize(n, std::string(result.front()));
      if (result.size() != n)
        throw InputError(where + name + ": there are " +
                         std::to_string(result.size()) +
                         " values, separated by ';', but " +
                         (n == 1 ? "one material. Name several in Material "
                                   "group, or give one value." :
                                   std::to_string(n) +
                                     " in Material group. Give one for each, "
                                     "or one for all."));
      return result;
    }

    std::vector<double>
    values(const ParameterHandler &prm,
           const std::string      &name,
           const std::size_t       n,
           const std::string      &where)
    {
      std::vector<double> result;
      for (const std::string &text : entries(prm, name, n, where))
        result.push_back(to_number(text, where + name));
      return result;
    }

    const std::vector<std::string> orthotropic_entries = {"Young moduli",
                                                          "Poisson ratios",
                                                          "Shear moduli"};

    void
    check(const Orthotropy &orthotropy, const std::string &where)
    {
      for (const auto &[values, name] :
           {std::pair(orthotropy.young, "Young moduli"),
            {orthotropy.shear, "Shear moduli"}})
        if (!(values.minCoeff() > 0))
          throw InputError(where + name + ": " + to_text(values.minCoeff()) +
                           " is not positive. Give stiffnesses above 0.");
      const Eigen::LLT<Eigen::MatrixXd> factor(orthotropy.compliance());
      if (factor.info() != Eigen::Success)
        throw InputError(where + "Poisson ratios: with these Young moduli the "
                                 "material would give off energy when it is "
                                 "pressed. Each nu_ij must be below "
                                 "sqrt(E_i / E_j), all of them together well "
                                 "below.");
    }

    Eigen::Vector3d
    three(const std::string &text, const std::string &entry)
    {
      const dealii::Tensor<1, 3> v = to_vector(text, 3, entry);
      return {v[0], v[1], v[2]};
    }

    /** Of each material; none if they are isotropic. */
    std::vector<Orthotropy>
    orthotropies(const ParameterHandler &prm,
                 const unsigned int      dim,
                 const std::size_t       n,
                 const std::string      &where)
    {
      const bool any = std::any_of(orthotropic_entries.begin(),
                                   orthotropic_entries.end(),
                                   [&](const std::string &name) {
                                     return !trim(prm.get(name)).empty();
                                   });
      if (!any)
        return {};
      for (const char *name : {"Young modulus", "Poisson ratio"})
        if (!trim(prm.get(name)).empty())
          throw InputError(where + name +
                           ": an orthotropic material has "
                           "Young moduli, Poisson ratios and "
                           "Shear moduli instead. Remove it.");
      const auto young   = entries(prm, orthotropic_entries[0], n, where);
      const auto poisson = entries(prm, orthotropic_entries[1], n, where);
      const auto shear   = entries(prm, orthotropic_entries[2], n, where);
      const auto axes    = entries(prm, "Axes", n, where);
      std::vector<Orthotropy> result;
      for (std::size_t i = 0; i < n; ++i)
        {
          Orthotropy material{three(young[i], where + "Young moduli"),
                              three(poisson[i], where + "Poisson ratios"),
                              three(shear[i], where + "Shear moduli")};
          const auto Q = parse_rotation(axes[i], dim, where + "Axes");
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              material.axes(a, b) = Q[a][b];
          check(material, where);
          result.push_back(material);
        }
      return result;
    }
  } // namespace

  namespace
  {
    /** Pairs of axes of the components: xx, yy, zz, xy, yz, zx. */
    constexpr int pairs[6][2] =
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

    /** Stresses in other axes, the columns of Q, from those in the scene's. */
    Eigen::MatrixXd
    turned_stresses(const Eigen::Matrix3d &Q)
    {
      Eigen::MatrixXd T(6, 6);
      for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
          {
            const auto [a, b] = pairs[row];
            const auto [i, j] = pairs[column];
            T(row, column)    = Q(i, a) * Q(j, b);
            if (i != j) // the component stands there twice
              T(row, column) += Q(j, a) * Q(i, b);
          }
      return T;
    }

    /** Of those in space, what a section sees; without stress along z. */
    Eigen::MatrixXd
    section_of(Eigen::MatrixXd c, const bool without_z)
    {
      if (without_z)
        c = (c - c.col(2) * c.row(2) / c(2, 2)).eval();
      Eigen::MatrixXd result = c.topLeftCorner(4, 4);
      if (without_z)
        {
          result.row(2).setZero();
          result.col(2).setZero();
        }
      return result;
    }

    void
    declare_orthotropic(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Young moduli",
        "",
        Patterns::Anything(),
        "E_1, E_2, E_3 of an orthotropic material (wood, plies) along its "
        "axes 1, 2, 3. They replace Young modulus and Poisson ratio. "
        "[force/length^2]");
      prm.declare_entry(
        "Poisson ratios",
        "",
        Patterns::Anything(),
        "nu_12, nu_13, nu_23 of an orthotropic material. A stress along i "
        "makes the strain e_i and the contraction nu_ij e_i along j; nu_ij / "
        "E_i = nu_ji / E_j. [-]");
      prm.declare_entry("Shear moduli",
                        "",
                        Patterns::Anything(),
                        "Of an orthotropic material: G_12, G_13, G_23. "
                        "[force/length^2]");
      prm.declare_entry(
        "Axes",
        "0",
        Patterns::Anything(),
        "How the axes 1, 2, 3 of an orthotropic material are turned from x, y, z "
        "of the scene: an angle about z, or in 3D an axis and an angle, 'x, y, "
        "z, angle'. Rotation of the mesh does not turn them. [degrees]");
    }
  } // namespace

  Eigen::MatrixXd
  Orthotropy::compliance() const
  {
    Eigen::MatrixXd s = Eigen::MatrixXd::Zero(6, 6);
    s.diagonal() << young.cwiseInverse(), 1 / shear[0], 1 / shear[2],
      1 / shear[1]; // 12, 23, 31
    s(0, 1) = s(1, 0) = -poisson[0] / young[0];
    s(0, 2) = s(2, 0) = -poisson[1] / young[0];
    s(1, 2) = s(2, 1) = -poisson[2] / young[1];
    // the same work in both axes: strains turn as T^T does
    const Eigen::MatrixXd T = turned_stresses(axes);
    return T.transpose() * s * T;
  }

  Eigen::MatrixXd
  ElasticMaterial::elasticity(const unsigned int dim) const
  {
    if (orthotropy)
      {
        Eigen::MatrixXd c = orthotropy->compliance().inverse();
        c                 = (.5 * (c + c.transpose())).eval();
        return dim == 3 ? c : section_of(c, plane == Plane::stress);
      }
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

  double
  ElasticMaterial::contrast_of_strains() const
  {
    // Shear strains as a tensor has them, twice, not the engineers'.
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(6);
    scale.tail(3).setConstant(std::sqrt(2.));
    const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() *
                                                       elasticity(3) *
                                                       scale.asDiagonal(),
                                                     Eigen::EigenvaluesOnly)
        .eigenvalues();
    return values.maxCoeff() / values.minCoeff();
  }

  /* Along z, too: in plane strain it presses against what holds the body
     there. */
  Eigen::VectorXd
  strain_components(const dealii::Tensor<2, 3> &strain, const unsigned int dim)
  {
    Eigen::VectorXd components(2 * dim);
    for (Eigen::Index k = 0; k < components.size(); ++k)
      {
        const auto [i, j] = pairs[k];
        components[k]     = i == j ? strain[i][i] : strain[i][j] + strain[j][i];
      }
    return components;
  }

  void
  declare_material(ParameterHandler &prm)
  {
    prm.enter_subsection("Material");
    prm.declare_entry(
      "Material group",
      "",
      Patterns::Anything(),
      "Empty: one material in all of the body. Else physical groups of cells "
      "of a Gmsh file, by name or number, a list with commas for each material, "
      "separated by ';', such as 'steel ; rubber, glue'. Young modulus, "
      "Poisson ratio, Expansion coefficient and the entries of orthotropic "
      "materials then have a value for each in this order, separated by ';', "
      "or one for all. Each cell must be in one of them. [-]");
    prm.declare_entry("Young modulus",
                      "",
                      Patterns::Anything(),
                      "Young's modulus E, above 0; must be given, unless "
                      "Young moduli are. A number or "
                      "a constant expression such as 210e3. "
                      "[force/length^2]");
    prm.declare_entry(
      "Poisson ratio",
      "",
      Patterns::Anything(),
      "Poisson's ratio nu, between -1 and 0.5; must be given, unless Young "
      "moduli are. "
      "Near 0.5 the elements Q1 become too stiff (locking); see "
      "Element. [-]");
    declare_orthotropic(prm);
    prm.declare_entry("Density",
                      "0",
                      Patterns::Double(0),
                      "Mass over volume, of all materials of the body; Gravity "
                      "makes a load of it. [mass/length^3]");
    prm.declare_entry("Plane",
                      "strain",
                      Patterns::Selection("strain|stress|axisymmetric"),
                      "2D only: plane strain (no strain along z, a long body), "
                      "plane stress (no stress along z, a thin plate), or a "
                      "body of revolution about the y axis, of which the mesh "
                      "is the half section x >= 0: x is the radius, y the "
                      "axis, stress zz goes round it. All forces of the scene "
                      "and its tables are then those of the whole "
                      "circumference, none is per radian: a point or nodal "
                      "force of 10 is 10 spread over its circle, along x "
                      "radially outward; a ring load q [force/length] is a "
                      "point force of 2*pi*r*q; tractions, pressures and "
                      "body forces stay per area and volume. Areas contain "
                      "2 pi r. The axis stays where it is by itself, only "
                      "translations along y are rigid motions. All bodies of "
                      "a scene are axisymmetric, or none. [-]");
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

  std::vector<MaterialOfGroups>
  parse_materials(ParameterHandler  &prm,
                  const unsigned int dim,
                  const std::string &body)
  {
    const std::string where = body + ", Material/";
    prm.enter_subsection("Material");
    std::vector<MaterialOfGroups> materials;
    for (const std::string &groups : split(prm.get("Material group"), ';'))
      materials.push_back({groups, {}});
    if (materials.empty())
      materials.emplace_back();
    const std::size_t   n          = materials.size();
    const auto          orthotropy = orthotropies(prm, dim, n, where);
    std::vector<double> young(n, 1), ratio(n, 0);
    if (orthotropy.empty())
      {
        young = values(prm, "Young modulus", n, where);
        ratio = values(prm, "Poisson ratio", n, where);
      }
    const auto alpha = values(prm, "Expansion coefficient", n, where);
    for (std::size_t i = 0; i < n; ++i)
      {
        ElasticMaterial &material = materials[i].material;
        material.young_modulus    = young[i];
        material.poisson_ratio    = ratio[i];
        material.expansion        = alpha[i];
        if (!orthotropy.empty())
          material.orthotropy = orthotropy[i];
        material.plane = plane_of(prm.get("Plane"));
        material.thickness =
          to_number(prm.get("Thickness"), where + "Thickness");
        check(material, where);
        if (n > 1 && materials[i].groups.empty())
          throw InputError(where + "Material group: a group is missing beside "
                                   "a ';'. Name it, or remove the ';'.");
      }
    prm.leave_subsection();
    return materials;
  }
} // namespace conetact::bodies
