// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/unloaded.h"

#include <gtest/gtest.h>

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  using Eigen::Index;

  /** A rigid bar over points x of a floor: unknowns (t, n), motions rise, turn.
   */
  ContactProblem
  bar(const std::vector<double> &x, const std::vector<double> &gaps)
  {
    auto       system = std::make_shared<ContactSystem>();
    const auto n      = static_cast<Index>(x.size());
    system->form      = Form::compliance;
    system->n_motions = 2;
    for (Index i = 1; i <= n; ++i)
      system->first.push_back(2 * i);
    system->first.insert(system->first.end(), {2 * n + 1, 2 * n + 2});
    system->mu     = Eigen::VectorXd::Constant(n, .3);
    system->matrix = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
    ContactProblem problem;
    problem.load = Eigen::VectorXd::Zero(2 * n + 2);
    problem.gap  = Eigen::VectorXd::Zero(n);
    for (Index i = 0; i < n; ++i)
      {
        const auto k                         = static_cast<std::size_t>(i);
        system->matrix(2 * i, 2 * i)         = 1e-3;
        system->matrix(2 * i + 1, 2 * i + 1) = 1e-3;
        system->matrix(2 * i + 1, 2 * n)     = 1;
        system->matrix(2 * i + 1, 2 * n + 1) = x[k];
        problem.load(2 * i + 1)              = gaps[k];
      }
    system->matrix.bottomLeftCorner(2, 2 * n) =
      -system->matrix.topRightCorner(2 * n, 2).transpose();
    problem.system = system;
    return problem;
  }

  ContactState
  at_rest(const ContactProblem &problem)
  {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.load.size());
    return {zero, zero, {}};
  }
} // namespace



TEST(Unloaded, TheShortestWayOutIsTheNearestPointOfACone)
{
  // a_1 >= .1, a_1 - a_2 >= .3
  Eigen::MatrixXd rows(2, 2);
  rows << 1, 0, 1, -1;
  const auto a = shortest_way_out(rows, Eigen::Vector2d(-.1, -.3));
  ASSERT_TRUE(a);
  EXPECT_LE((*a - Eigen::Vector2d(.15, -.15)).norm(), 1e-15);
  // a_1 >= 1, -a_1 >= 1
  rows << 1, 0, -1, 0;
  EXPECT_FALSE(shortest_way_out(rows, Eigen::Vector2d(-1, -1)));
  EXPECT_EQ(shortest_way_out(rows, Eigen::Vector2d(1, 0))->norm(), 0);
}



TEST(Unloaded, TakesTheShortestWayOut)
{
  // |a| least with a_1 >= .1, a_1 - a_2 >= .3, a_1 + a_2 >= -1
  const auto problem = bar({0, -1, 1}, {-.1, -.3, 1});
  const auto end     = move_without_load(problem, at_rest(problem));
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->r(6), .15, 1e-15);
  EXPECT_NEAR(end->r(7), -.15, 1e-15);
  EXPECT_TRUE(end->r.head(6).isZero(0));
  EXPECT_NEAR(end->v(1), .05, 1e-15);
  EXPECT_NEAR(end->v(3), 0, 1e-15);
  EXPECT_NEAR(end->v(5), 1, 1e-15);
}



TEST(Unloaded, NodesJoinThatTheMotionPushesIn)
{
  // out of the first the bar turns into the second
  const auto problem = bar({1, -1}, {-.4, .01});
  const auto end     = move_without_load(problem, at_rest(problem));
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->v(1), 0, 1e-15);
  EXPECT_GE(end->v(3), 0);
}



TEST(Unloaded, StaysWhereNothingIsInTheWay)
{
  const auto problem = bar({-1, 1}, {0, .2});
  const auto end     = stay_without_load(problem, at_rest(problem));
  ASSERT_TRUE(end);
  EXPECT_TRUE(end->r.isZero(0));
  EXPECT_FALSE(stay_without_load(bar({-1, 1}, {0, -.2}), at_rest(problem)));
}



TEST(Unloaded, LeavesLoadsJammedBodiesAndFoundationsToSolvers)
{
  auto problem = bar({-1, 1}, {-.1, -.1});
  auto start   = at_rest(problem);
  start.r(1)   = 1;
  EXPECT_FALSE(move_without_load(problem, start));
  start.r(1)      = 0;
  problem.load(4) = 1e-3;
  EXPECT_FALSE(move_without_load(problem, start));
  problem.load(4)        = 0;
  auto resisted          = std::make_shared<ContactSystem>(*problem.system);
  resisted->matrix(4, 4) = 1;
  problem.system         = resisted;
  EXPECT_FALSE(move_without_load(problem, start));
}



TEST(Unloaded, FindsNoWayOutOfAPressFit)
{
  // two walls that face each other
  auto problem = bar({0, 0}, {-.1, -.1});
  auto walls   = std::make_shared<ContactSystem>(*problem.system);
  walls->matrix.row(3).tail(2) *= -1;
  walls->matrix.col(3).tail(2) *= -1;
  problem.system = walls;
  EXPECT_FALSE(move_without_load(problem, at_rest(problem)));
}
