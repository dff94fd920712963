// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/reproductions/published_smoothing.h"

#include <gtest/gtest.h>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::reproductions;
using namespace conetact::solvers;

TEST(PublishedSmoothing, StopsOnItsOwnTolerance)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const PublishedSet &set : published_sets())
      {
        RandomOptions o;
        o.form = form;
        const PublishedRun run =
          solve_as_published(random_problem(o).problem, set);
        EXPECT_TRUE(run.failure.empty()) << run.failure;
        EXPECT_LE(run.natural, 1e-8);
        EXPECT_LT(run.iterations, 40u);
        EXPECT_LT(run.residual, 1e-7);
      }
}

TEST(PublishedSmoothing, DependsOnUnits)
{
  RandomOptions o;
  const auto    run = [&] {
    return solve_as_published(random_problem(o).problem, published_sets()[0]);
  };
  const unsigned int iterations = run().iterations;
  o.force                       = 1e6;
  EXPECT_NE(run().iterations, iterations);
}

TEST(PublishedSmoothing, SaysWhyItGivesUp)
{
  // Nothing holds the body, and the load pulls it away.
  auto system    = std::make_shared<ContactSystem>();
  system->first  = {0, 2};
  system->matrix = Eigen::MatrixXd::Zero(2, 2);
  system->mu     = Eigen::VectorXd::Constant(1, .5);
  ContactProblem problem;
  problem.system = system;
  problem.load   = Eigen::Vector2d(0, 1);
  problem.gap    = Eigen::VectorXd::Zero(1);
  EXPECT_FALSE(
    solve_as_published(problem, published_sets()[0]).failure.empty());
}
