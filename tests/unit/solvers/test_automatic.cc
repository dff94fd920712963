// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/automatic.h"
#include "conetact/solvers/solver_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  SolverReport
  solve(const ContactProblem &problem,
        ContactState         &state,
        const std::string    &method = "automatic")
  {
    SolverOptions options;
    options.method = method;
    state          = unloaded(problem);
    return make_solver(options)->solve(problem, state);
  }

  /** One node in 2D on springs: everything can be said by hand. */
  ContactProblem
  one_node(const double tangential, const double normal, const double mu)
  {
    auto system    = std::make_shared<ContactSystem>();
    system->first  = {0, 2};
    system->matrix = Eigen::Matrix2d::Identity();
    system->mu     = Eigen::VectorXd::Constant(1, mu);
    ContactProblem problem;
    problem.system = system;
    problem.load   = Eigen::Vector2d(tangential, normal);
    problem.gap    = Eigen::VectorXd::Zero(1);
    return problem;
  }
} // namespace

TEST(Automatic, KnowsItsNames)
{
  SolverOptions options;
  options.method = "magic";
  EXPECT_THROW(make_solver(options), std::invalid_argument);
  for (const SolverRow &row : solver_table())
    {
      options.method = row.name;
      EXPECT_NE(make_solver(options), nullptr);
    }
}

TEST(Automatic, ResidualSeesEveryLaw)
{
  ContactState         state;
  const ContactProblem problem = one_node(0, -1, .5);
  state.v                      = Eigen::Vector2d(0, 0);
  state.r                      = Eigen::Vector2d(0, 1);
  EXPECT_EQ(contact_residual(problem, state), 0);
  state.r = Eigen::Vector2d(.6, 1); // outside the cone and out of balance
  EXPECT_GT(contact_residual(problem, state), .05);
  state.v = Eigen::Vector2d(0, 1); // open and pressed
  state.r = Eigen::Vector2d(0, 2);
  EXPECT_GT(contact_residual(problem, state), .1);
  state.v = Eigen::Vector2d(.1, 0); // slips without friction
  state.r = Eigen::Vector2d(.1, 1);
  EXPECT_GT(contact_residual(problem, state), .05);
  state.r(0) = std::nan("");
  EXPECT_FALSE(contact_residual(problem, state) < 1e300);
}

TEST(Automatic, OneNodeByHand)
{
  ContactState state;
  for (const auto &row : solver_table())
    {
      EXPECT_TRUE(solve(one_node(.3, -1, .5), state, row.name).converged);
      EXPECT_EQ(state.node[0], NodeState::stick) << row.name;
      EXPECT_NEAR(state.r(0), -.3, 1e-10);
      EXPECT_TRUE(solve(one_node(.8, -1, .5), state, row.name).converged);
      EXPECT_EQ(state.node[0], NodeState::slip) << row.name;
      EXPECT_NEAR(state.v(0), .3, 1e-10);
      EXPECT_NEAR(state.r(0), -.5, 1e-10);
      EXPECT_TRUE(solve(one_node(.8, 1, .5), state, row.name).converged);
      EXPECT_EQ(state.node[0], NodeState::open) << row.name;
      EXPECT_NEAR(state.v(1), 1, 1e-10);
      EXPECT_TRUE(solve(one_node(.8, -1, 0), state, row.name).converged);
      EXPECT_NEAR(state.v(0), .8, 1e-10) << row.name;
      EXPECT_NEAR(state.r(0), 0, 1e-10) << row.name;
    }
}

TEST(Automatic, NothingToDo)
{
  ContactProblem problem;
  problem.system = std::make_shared<ContactSystem>();
  ContactState state;
  EXPECT_TRUE(solve(problem, state).converged);
  EXPECT_TRUE(solve(one_node(0, 0, .5), state).converged);
  EXPECT_TRUE(state.r.isZero(0));
}

TEST(Automatic, SolvesRandomProblems)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const int tangents : {0, 1, 2, -1})
      for (const Eigen::Index n : {1, 3, 10, 50})
        for (unsigned int seed = 1; seed < 11; ++seed)
          {
            RandomOptions o;
            o.form                     = form;
            o.tangents                 = tangents;
            o.n_nodes                  = n;
            o.seed                     = seed;
            o.nullity                  = n > 3 ? seed % 4 : 0;
            o.zero_mu                  = .1;
            o.mu_max                   = seed % 2 ? .5 : 2;
            const RandomProblem random = random_problem(o);
            ContactState        state;
            const SolverReport  report = solve(random.problem, state);
            EXPECT_TRUE(report.converged)
              << report.reason << " n " << n << " seed " << seed;
            EXPECT_TRUE(report.substeps > 1 ||
                        contact_residual(random.problem, state) <= 1e-10);
          }
}

TEST(Automatic, LargeProblem)
{
  RandomOptions o;
  o.n_nodes                  = 300;
  const RandomProblem random = random_problem(o);
  ContactState        state;
  EXPECT_TRUE(solve(random.problem, state).converged);
  EXPECT_LE(contact_residual(random.problem, state), 1e-10);
}

TEST(Automatic, SolversAgreeWhereTheSolutionIsUnique)
{
  for (unsigned int seed = 1; seed < 11; ++seed)
    {
      RandomOptions o;
      o.n_nodes                  = 15;
      o.mu_max                   = .2;
      o.tangents                 = seed % 2 ? 1 : 2;
      o.seed                     = seed;
      const RandomProblem random = random_problem(o);
      for (const char *method : {"automatic", "smoothing"})
        {
          ContactState state;
          EXPECT_TRUE(solve(random.problem, state, method).converged);
          EXPECT_LT((state.r - random.solution.r).norm(), 1e-9) << method;
          EXPECT_LT((state.v - random.solution.v).norm(), 1e-9) << method;
        }
    }
}

TEST(Automatic, DoesNotDependOnUnits)
{
  RandomOptions o;
  o.n_nodes = 30;
  ContactState       reference;
  const SolverReport first = solve(random_problem(o).problem, reference);
  for (const double length : {1e-9, 1e9})
    for (const double force : {1e-9, 1e9})
      {
        o.length = length;
        o.force  = force;
        ContactState       state;
        const SolverReport report = solve(random_problem(o).problem, state);
        EXPECT_EQ(report.iterations, first.iterations);
        EXPECT_LT((state.r / force - reference.r).norm(), 1e-12);
        EXPECT_EQ(state.node, reference.node);
      }
}

TEST(Automatic, NoEquilibriumIsAReport)
{
  // A floating node, pulled off: no stiffness, nothing to hold it.
  auto system          = std::make_shared<ContactSystem>();
  system->first        = {0, 2, 4};
  system->matrix       = Eigen::MatrixXd::Zero(4, 4);
  system->matrix(1, 1) = system->matrix(3, 3) = 1;
  system->matrix(1, 3) = system->matrix(3, 1) = -1;
  system->mu = Eigen::VectorXd::Constant(2, .5);
  ContactProblem problem;
  problem.system = system;
  problem.load   = Eigen::Vector4d(0, 1, 0, 1);
  problem.gap    = Eigen::VectorXd::Zero(2);
  ContactState       state;
  const SolverReport report = solve(problem, state);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("of the load"), std::string::npos)
    << report.reason;
}

TEST(Automatic, ForcesThatRunAwayHideNothing)
{
  // Two rigid nodes wedged between walls that are closer than they are wide:
  // the larger the force, the smaller beside it is what is violated.
  auto system    = std::make_shared<ContactSystem>();
  system->form   = Form::compliance;
  system->first  = {0, 1, 2};
  system->matrix = (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  system->mu     = Eigen::VectorXd::Zero(2);
  ContactProblem problem;
  problem.system = system;
  problem.load   = Eigen::Vector2d(-1, .5);
  problem.gap    = Eigen::VectorXd::Zero(2);
  ContactState state;
  state.v    = Eigen::Vector2d::Zero();
  state.node = {NodeState::stick, NodeState::stick};
  for (const double force : {1., 1e6, 1e12, 1e18})
    {
      state.r = Eigen::Vector2d(force, force);
      EXPECT_GT(contact_residual(problem, state), 1e-6) << force;
    }
  EXPECT_FALSE(solve(problem, state).converged);
}

TEST(Automatic, LoadsFollowOneAnother)
{
  // Pressed, pushed to slip, held, pulled off: a history of one node.
  SolverOptions   options;
  const auto      solver     = make_solver(options);
  ContactProblem  problem    = one_node(0, -1, .5);
  ContactState    state      = unloaded(problem);
  double          slip       = 0;
  const double    loads[][2] = {{0, -1}, {1, -1}, {.6, -1}, {.6, 1}};
  const NodeState expected[] = {NodeState::stick,
                                NodeState::slip,
                                NodeState::stick,
                                NodeState::open};
  for (int k = 0; k < 4; ++k)
    {
      problem.load   = Eigen::Vector2d(loads[k][0] - slip, loads[k][1]);
      problem.gap(0) = state.v(1);
      state.v(0)     = 0;
      EXPECT_TRUE(solver->solve(problem, state).converged);
      EXPECT_EQ(state.node[0], expected[k]) << k;
      slip += state.v(0);
    }
  EXPECT_NEAR(slip, .6, 1e-12);
}
