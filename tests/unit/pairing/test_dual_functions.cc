// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/dual_functions.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace conetact::pairing;
using Eigen::Index;

namespace
{
  /** Products and integrals of the bilinear functions of the unit square over
   * its part [0, a] x [0, b]; nodes as deal.II numbers them. */
  struct Covered
  {
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(4, 4);
    Eigen::VectorXd areas;
    Covered(const double a, const double b)
      : areas(4)
    {
      const auto pairs = [](const double c) {
        Eigen::Matrix2d m;
        m(0, 0) = c - c * c + c * c * c / 3;
        m(1, 1) = c * c * c / 3;
        m(0, 1) = m(1, 0) = c * c / 2 - c * c * c / 3;
        return m;
      };
      const Eigen::Matrix2d x = pairs(a), y = pairs(b);
      for (Index i = 0; i < 4; ++i)
        for (Index j = 0; j < 4; ++j)
          mass(i, j) = x(i % 2, j % 2) * y(i / 2, j / 2);
      areas = mass.rowwise().sum();
    }
  };
} // namespace



TEST(DualFunctions, KeptOnesSumToOneAndSeeNoOtherKeptNode)
{
  for (const auto &[a, b] : {std::pair(1., 1.), {.5, 1.}, {1., 1e-6}, {.3, .2}})
    for (const std::vector<Index> &kept :
         {std::vector<Index>{0}, {0, 1}, {0, 1, 2}, {1, 3}, {0, 1, 2, 3}})
      {
        const Covered         part(a, b);
        const Eigen::MatrixXd A = dual_functions(part.mass, part.areas, kept);
        EXPECT_NEAR((A.colwise().sum().array() - 1).abs().maxCoeff(),
                    0,
                    1e-12 / b);
        for (Index j = 0; j < 4; ++j)
          if (std::find(kept.begin(), kept.end(), j) == kept.end())
            {
              EXPECT_EQ(A.row(j).norm(), 0);
            }
        const Eigen::MatrixXd D = A * part.mass;
        if (b == 1) // else they may be too far from independent
          for (const Index j : kept)
            for (const Index k : kept)
              {
                EXPECT_NEAR(D(j, k), j == k ? part.areas[j] : 0, 1e-15);
              }
      }
}



TEST(DualFunctions, OfASliverAlongAnEdgeAreThoseOfTheEdge)
{
  const Covered         sliver(1, 1e-9);
  const Eigen::MatrixXd A = dual_functions(sliver.mass, sliver.areas, {0, 1});
  const Eigen::MatrixXd D = A * sliver.mass;
  EXPECT_NEAR(D(0, 0), .5e-9, 1e-17);
  EXPECT_NEAR(D(0, 1), 0, 1e-17);
  EXPECT_NEAR(A(0, 0), 2, 1e-6);
  EXPECT_NEAR(A(0, 1), -1, 1e-6);
}



TEST(DualFunctions, OfOneNodeIsConstant)
{
  const Covered part(.1, .7);
  EXPECT_EQ(dual_functions(part.mass, part.areas, {3}).row(3),
            Eigen::RowVectorXd::Ones(4));
}



/* On a segment: nodes at 0, 1 and 1/2. */
TEST(CornerFunctions, SeeTheirOwnCornerAndWhatLinearPressuresGiveMiddles)
{
  Eigen::Matrix3d mass; // of the shape functions of second degree
  mass << 4, -1, 2, -1, 4, 2, 2, 2, 16;
  mass /= 30;
  Eigen::MatrixXd linear(2, 3);
  linear << 1, 0, .5, 0, 1, .5;
  const Eigen::MatrixXd A         = corner_functions(mass, linear),
                        integrals = A * mass, of_linear = linear * mass;
  Eigen::Matrix2d half = Eigen::Matrix2d::Identity() / 2;
  EXPECT_NEAR((integrals * linear.transpose() - half).norm(), 0, 1e-14);
  EXPECT_NEAR((integrals.col(2) - of_linear.col(2)).norm(), 0, 1e-14);
  EXPECT_NEAR((A.colwise().sum().array() - 1).abs().maxCoeff(), 0, 1e-13);
  EXPECT_NEAR((corner_integrals(of_linear, linear) - integrals).norm(),
              0,
              1e-14);
}
