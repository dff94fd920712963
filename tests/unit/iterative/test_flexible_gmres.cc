// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/flexible_gmres.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace conetact;
  using namespace conetact::iterative;
  using Eigen::Index;
  using Eigen::MatrixXf;

  constexpr Index n = 200;

  MatrixXf
  numbers(const Index rows, const Index columns, const unsigned int seed)
  {
    std::mt19937                    generator(seed);
    std::normal_distribution<float> number;
    return MatrixXf::NullaryExpr(rows, columns, [&](auto, auto) {
      return number(generator);
    });
  }

  FloatVector
  load()
  {
    return numbers(n, 1, 1).col(0).normalized();
  }

  struct Solved
  {
    double       left;
    unsigned int iterations = 0;
  };

  /** What is left of the load, made anew in double precision. */
  Solved
  solve(const MatrixXf &A, const double goal)
  {
    Solved            result;
    const FloatVector b = load();
    const FloatVector x = FlexibleGmres(Communicator())
                            .solve(
                              b,
                              goal,
                              [&](const auto &in, auto &out) { out = A * in; },
                              [](const auto &in, auto &out) { out = in; },
                              result.iterations);
    result.left =
      (b.cast<double>() - A.cast<double>() * x.cast<double>()).norm();
    return result;
  }
} // namespace



// What it says is left is what is left, of a matrix that is not symmetric.
TEST(FlexibleGmres, LeavesNoMoreThanItsGoal)
{
  const MatrixXf A = MatrixXf::Identity(n, n) + .03f * numbers(n, n, 2);
  for (const double goal : {1e-2, 1e-4})
    {
      const Solved solved = solve(A, goal);
      EXPECT_LE(solved.left, 1.001 * goal);
      EXPECT_LT(solved.iterations, FlexibleGmres::cycle_length);
    }
}



// Three directions differ from the identity: four iterations know them all.
TEST(FlexibleGmres, EndsWithTheDirectionsThereAre)
{
  const MatrixXf A =
    MatrixXf::Identity(n, n) + .005f * numbers(n, 3, 3) * numbers(3, n, 4);
  const Solved solved = solve(A, 1e-4);
  EXPECT_LE(solved.left, 1.001e-4);
  EXPECT_LE(solved.iterations, 4u);
}



// A v is nearly v: nearly all digits of what is left of it cancel.
TEST(FlexibleGmres, ProductsMayHardlyDifferFromDirections)
{
  for (const float far : {1e-3f, 1e-5f, 0.f})
    {
      const MatrixXf A = MatrixXf::Identity(n, n) + far / 14 * numbers(n, n, 5);
      const Solved   solved = solve(A, 1e-4);
      EXPECT_LE(solved.left, 2e-4) << far;
      EXPECT_LE(solved.iterations, 3u) << far;
    }
}
