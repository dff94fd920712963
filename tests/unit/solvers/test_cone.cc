// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/cone.h"

#include <gtest/gtest.h>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  SmallVector
  random_vector(internal::Random &random, const Eigen::Index n)
  {
    SmallVector z(n);
    for (Eigen::Index i = 0; i < n; ++i)
      z(i) = internal::uniform(random, -1, 1);
    return z;
  }
} // namespace

TEST(Cone, SpectrumPutsTheVectorTogetherAgain)
{
  internal::Random random(1);
  for (int k = 0; k < 100; ++k)
    for (const Eigen::Index n : {1, 2, 3})
      {
        const SmallVector z = random_vector(random, n);
        const Spectrum    s = spectrum(z);
        EXPECT_LE(s.l1, s.l2);
        EXPECT_LT((s.l1 * s.u1 + s.l2 * s.u2 - z).norm(), 1e-15);
      }
  const Spectrum zero = spectrum(SmallVector::Zero(3));
  EXPECT_TRUE(zero.u1.allFinite() && zero.u2.allFinite());
}

TEST(Cone, ProjectionSplitsIntoConeAndPolar)
{
  internal::Random random(2);
  for (int k = 0; k < 200; ++k)
    for (const Eigen::Index n : {1, 2, 3})
      {
        // Moreau: z = P(z) - P(-z), and both parts are orthogonal
        const SmallVector z = random_vector(random, n), p = project(z);
        EXPECT_GE(p(0) - p.tail(n - 1).norm(), -1e-15);
        EXPECT_LT((p - project(-z) - z).norm(), 1e-15);
        EXPECT_NEAR(p.dot(p - z), 0, 1e-15);
      }
}

TEST(Cone, FrictionConeIsTheSecondOrderConeStretched)
{
  internal::Random random(3);
  for (int k = 0; k < 300; ++k)
    for (const double mu : {0., .1, 1., 100.})
      for (const Eigen::Index n : {1, 2, 3})
        {
          const SmallVector r = random_vector(random, n);
          const SmallVector p = project_on_friction_cone(r, mu);
          EXPECT_GE(p(n - 1), 0);
          EXPECT_LE(p.head(n - 1).norm(), mu * p(n - 1) * (1 + 1e-14));
          EXPECT_LE((project_on_friction_cone(p, mu) - p).norm(), 1e-14);
          // No other point of the cone is nearer.
          const SmallVector q =
            project_on_friction_cone(p + .1 * random_vector(random, n), mu);
          EXPECT_LE((r - p).norm(), (r - q).norm() + 1e-15);
        }
}

TEST(Cone, SmoothedProjectionTendsToTheProjection)
{
  internal::Random random(4);
  for (int k = 0; k < 100; ++k)
    for (const Eigen::Index n : {1, 2, 3})
      {
        const SmallVector z = random_vector(random, n);
        for (const double m : {1e-2, 1e-5, 1e-9})
          EXPECT_LE((smoothed_projection(z, m).value - project(z)).norm(),
                    2 * m);
      }
}

TEST(Cone, DerivativeAgreesWithDifferences)
{
  internal::Random random(5);
  const double     step = 1e-6;
  for (int k = 0; k < 100; ++k)
    for (const Eigen::Index n : {1, 2, 3})
      for (const double m : {1., .1, .01})
        {
          const SmallVector        z = random_vector(random, n);
          const SmoothedProjection s = smoothed_projection(z, m);
          for (Eigen::Index j = 0; j < n; ++j)
            {
              SmallVector up = z, down = z;
              up(j) += step;
              down(j) -= step;
              const SmallVector difference =
                (smoothed_projection(up, m).value -
                 smoothed_projection(down, m).value) /
                (2 * step);
              EXPECT_LT((difference - s.derivative.col(j)).norm(), 1e-6);
            }
          EXPECT_LT(
            (s.derivative + s.complement - SmallMatrix::Identity(n, n)).norm(),
            1e-14);
        }
}

TEST(Cone, ComplementIsNotRoundOff)
{
  // Far inside the cone 1 - g'(a) is about 1/a^2, which 1 - (1 - ...) loses.
  SmallVector z(3);
  z << 3, 1, 0;
  const double             m = 1e-10;
  const SmoothedProjection s = smoothed_projection(z, m);
  const double             a = m * m / 16, b = m * m / 4;
  EXPECT_NEAR(s.complement(0, 0) / (.5 * (a + b)), 1, 1e-6);
  EXPECT_NEAR(s.complement(0, 1) / (.5 * (a - b)), 1, 1e-6);
  // and outside, in the polar cone, so is g'(a) itself
  const SmoothedProjection t = smoothed_projection(-z, m);
  EXPECT_NEAR(t.derivative(0, 0) / (.5 * (a + b)), 1, 1e-6);
  EXPECT_NEAR(t.derivative(0, 1) / (.5 * (a - b)), 1, 1e-6);
  EXPECT_GT(t.value(0), 0);
}
