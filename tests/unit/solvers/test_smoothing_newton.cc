// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/smoothing_newton.h"

#include <gtest/gtest.h>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  SolverReport
  solve(const ContactProblem &problem,
        ContactState         &state,
        const SolverOptions  &options = {})
  {
    state = unloaded(problem);
    return make_smoothing_newton(options)->solve(problem, state);
  }
} // namespace

TEST(Smoothing, SolvesRandomProblems)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const int tangents : {0, 1, 2, -1})
      for (const Eigen::Index n : {1, 2, 7, 40})
        for (unsigned int seed = 1; seed < 6; ++seed)
          {
            RandomOptions o;
            o.form                     = form;
            o.tangents                 = tangents;
            o.n_nodes                  = n;
            o.seed                     = seed;
            o.nullity                  = seed == 5 && n > 2 ? 2 : 0;
            o.zero_mu                  = .2;
            const RandomProblem random = random_problem(o);
            ContactState        state;
            const SolverReport  report = solve(random.problem, state);
            EXPECT_TRUE(report.converged) << report.reason;
            EXPECT_EQ(report.residual, contact_residual(random.problem, state));
            EXPECT_LE(report.residual, 1e-10);
          }
}

TEST(Smoothing, DoesNotDependOnUnits)
{
  RandomOptions o;
  o.n_nodes = 20;
  ContactState       reference;
  const SolverReport first = solve(random_problem(o).problem, reference);
  for (const double length : {1e-9, 1e-3, 1e9})
    for (const double force : {1e-9, 1e6, 1e9})
      {
        o.length = length;
        o.force  = force;
        ContactState       state;
        const SolverReport report = solve(random_problem(o).problem, state);
        EXPECT_EQ(report.iterations, first.iterations);
        EXPECT_LT((state.r / force - reference.r).norm(), 1e-12);
        EXPECT_LT((state.v / length - reference.v).norm(), 1e-12);
      }
}

TEST(Smoothing, GivesUpInWords)
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
  ContactState       state;
  const SolverReport report = solve(problem, state);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
}
