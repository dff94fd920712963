// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/material.h"
#include "conetact/bodies/placement.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace conetact::test
{
  using namespace bodies;

  namespace
  {
    Eigen::Matrix3d
    turned(const double x, const double y, const double z, const double degrees)
    {
      const auto Q = rotation_about(dealii::Tensor<1, 3>({x, y, z}), degrees);
      Eigen::Matrix3d result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result(i, j) = Q[i][j];
      return result;
    }

    const Orthotropy wood{{1000, 400, 250}, {.3, .25, .35}, {300, 200, 120}};
  } // namespace

  TEST(Orthotropy, EqualModuliAreIsotropic)
  {
    ElasticMaterial plain, turned_one;
    plain.young_modulus   = 5;
    turned_one.orthotropy = Orthotropy{{5, 5, 5},
                                       {.3, .3, .3},
                                       Eigen::Vector3d::Constant(5 / 2.6),
                                       turned(1., 2., -1., 27)};
    for (const auto plane : {ElasticMaterial::Plane::strain,
                             ElasticMaterial::Plane::stress,
                             ElasticMaterial::Plane::axisymmetric})
      for (const unsigned int dim : {2, 3})
        {
          plain.plane = turned_one.plane = plane;
          EXPECT_LT((plain.elasticity(dim) - turned_one.elasticity(dim)).norm(),
                    1e-13);
        }
    EXPECT_EQ(turned_one.stiffness(), 5);
    EXPECT_NEAR(turned_one.contrast_of_strains(),
                plain.contrast_of_strains(),
                1e-12);
  }

  TEST(Isotropy, ContrastOfStrains)
  {
    // of 3 K and 2 G
    for (const double nu : {0., .1, .3, .49, .4999, -.5})
      {
        ElasticMaterial material;
        material.poisson_ratio = nu;
        material.young_modulus = 2e5;
        const double ratio     = (1 + nu) / (1 - 2 * nu);
        EXPECT_NEAR(material.contrast_of_strains() / std::max(ratio, 1 / ratio),
                    1,
                    1e-10)
          << nu;
      }
  }

  TEST(Orthotropy, AxesTurn)
  {
    // a right angle about z exchanges 1 and 2
    Orthotropy other        = wood;
    other.axes              = turned(0., 0., 1., 90);
    const Eigen::MatrixXd s = wood.compliance(), t = other.compliance();
    const int             places[] = {1, 0, 2, 3, 5, 4};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        EXPECT_NEAR(t(places[i], places[j]), s(i, j), 1e-18);
    EXPECT_DOUBLE_EQ(s(0, 1), -.3 / 1000);
    EXPECT_DOUBLE_EQ(s(3, 3), 1. / 300);
    EXPECT_DOUBLE_EQ(s(4, 4), 1. / 120);
    EXPECT_DOUBLE_EQ(s(5, 5), 1. / 200);

    // along any direction 1/E = c^4/E_1 + s^4/E_2 + (1/G - 2 nu/E_1) c^2 s^2
    other.axes = turned(0., 0., 1., -30);
    EXPECT_NEAR(other.compliance()(0, 0),
                9. / 16 / 1000 + 1. / 16 / 400 +
                  3. / 16 * (1. / 300 - .6 / 1000),
                1e-17);
  }

  TEST(Orthotropy, PlaneStressHasNoneAlongZ)
  {
    ElasticMaterial plate;
    plate.orthotropy          = wood;
    plate.orthotropy->axes    = turned(0., 0., 1., 20);
    plate.plane               = ElasticMaterial::Plane::stress;
    const Eigen::MatrixXd c   = plate.elasticity(2);
    const Eigen::MatrixXd s   = plate.orthotropy->compliance();
    const int             k[] = {0, 1, 3};
    for (const int i : k)
      for (const int j : k)
        {
          double sum = 0;
          for (const int l : k)
            sum += c(i, l) * s(l, j);
          EXPECT_NEAR(sum, i == j, 1e-13);
        }
    EXPECT_EQ(c.row(2).norm() + c.col(2).norm(), 0);
  }
} // namespace conetact::test
