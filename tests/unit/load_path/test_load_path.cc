// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/load_path.h"
#include "conetact/solvers/lcp.h"

#include <gtest/gtest.h>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::load_path;
using namespace conetact::solvers;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  struct OneNode
  {
    ContactSystem system;
    PathOptions   options;
    PathPoint     before, point;

    OneNode()
    {
      system.first     = {0, 2};
      system.matrix    = MatrixXd::Identity(2, 2);
      system.mu        = VectorXd::Constant(1, .5);
      before.v         = Eigen::Vector2d(0, 0);
      before.r         = Eigen::Vector2d(0, 0);
      options.cohesion = VectorXd::Zero(1);
    }

    /** In equilibrium: only the law is in question. */
    double
    residual(const Eigen::Vector2d &v, const Eigen::Vector2d &r)
    {
      point.v = v;
      point.r = r;
      return path_residual(
        system, options, system.matrix * v - r, before, point);
    }
  };
} // namespace

TEST(LoadPath, ResidualSeesEveryLaw)
{
  OneNode node;
  EXPECT_EQ(node.residual({0, 0}, {.4, 1}), 0);   // sticks
  EXPECT_EQ(node.residual({1, 0}, {-.5, 1}), 0);  // slips
  EXPECT_EQ(node.residual({1, 2}, {0, 0}), 0);    // open
  EXPECT_GT(node.residual({0, 0}, {.6, 1}), .05); // too much friction
  EXPECT_GT(node.residual({1, 0}, {.5, 1}), .05); // friction that drives
  EXPECT_GT(node.residual({1, 0}, {0, 1}), .05);  // slip without friction
  EXPECT_GT(node.residual({0, 1}, {0, 1}), .05);  // force over a gap
  EXPECT_GT(node.residual({0, -1}, {0, 0}), .05); // interpenetration
  EXPECT_GT(node.residual({0, 0}, {0, -1}), .05); // suction
  EXPECT_GT(node.residual({std::nan(""), 0}, {0, 0}), 1);
  EXPECT_GT(path_residual(node.system,
                          node.options,
                          Eigen::Vector2d(0, -1.1),
                          node.before,
                          (node.residual({0, 0}, {0, 1}), node.point)),
            .05); // out of balance
}

TEST(LoadPath, ResidualKnowsBothLawsAndCohesion)
{
  OneNode node;
  node.before.v = Eigen::Vector2d(2, 0);
  EXPECT_EQ(node.residual({1, 0}, {.5, 1}), 0); // back towards the start
  node.options.law = PathLaw::holonomic;
  EXPECT_GT(node.residual({1, 0}, {.5, 1}), .05);
  EXPECT_EQ(node.residual({1, 0}, {-.5, 1}), 0);
  node.options.cohesion(0) = .25;
  EXPECT_GT(node.residual({1, 0}, {-.5, 1}), .05);
  EXPECT_EQ(node.residual({1, 0}, {-.75, 1}), 0);
  EXPECT_EQ(node.residual({1, 1}, {-.25, 0}), 0); // open, held back
  EXPECT_EQ(node.residual({0, 1}, {.2, 0}), 0);
}

TEST(Lcp, SolvesRandomProblems)
{
  for (unsigned int seed = 0; seed < 50; ++seed)
    {
      internal::Random random(seed);
      const Index      n = 1 + seed;
      const MatrixXd   B = internal::random_matrix(random, n, n);
      const MatrixXd   S = internal::random_matrix(random, n, n);
      const MatrixXd   M =
        B * B.transpose() + .1 * MatrixXd::Identity(n, n) + S - S.transpose();
      const VectorXd q = internal::random_matrix(random, n, 1);
      VectorXd       z;
      ASSERT_TRUE(
        solve_lcp(M, q, VectorXd::Ones(n), Eigen::VectorXi::Zero(n), z));
      const VectorXd x = M * z + q;
      EXPECT_GE(z.minCoeff(), 0);
      EXPECT_LE(x.cwiseMin(z).lpNorm<Eigen::Infinity>(), 1e-9);
    }
}

TEST(Lcp, EndsOnARayWhereThereIsNoSolution)
{
  VectorXd z;
  EXPECT_FALSE(solve_lcp(-MatrixXd::Identity(2, 2),
                         Eigen::Vector2d(-1, 1),
                         VectorXd::Ones(2),
                         Eigen::VectorXi::Zero(2),
                         z));
}
