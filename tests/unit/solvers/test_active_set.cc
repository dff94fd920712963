// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/active_set.h"
#include "conetact/solvers/predictor.h"

#include <gtest/gtest.h>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  SolverReport
  solve(const ContactProblem &problem, ContactState &state)
  {
    return make_active_set({})->solve(problem, state);
  }

  /** The increment after one that ended with `state`, under the same load. */
  ContactProblem
  next_increment(ContactProblem problem, ContactState &state)
  {
    const ContactSystem &system = *problem.system;
    Eigen::VectorXd      slip   = state.v;
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      {
        slip(system.normal(i)) = 0;
        problem.gap(i)         = state.v(system.normal(i));
      }
    if (system.form == Form::stiffness)
      problem.load -= system.matrix * slip;
    else
      problem.load -= slip;
    state.v -= slip;
    return problem;
  }

  void
  expect_exact_zeros(const ContactSystem &system, const ContactState &state)
  {
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      {
        const auto node  = state.node[static_cast<std::size_t>(i)];
        const auto first = system.first[i], nt = system.n_tangents(i);
        if (node == NodeState::open)
          {
            EXPECT_TRUE(state.r.segment(first, nt + 1).isZero(0));
            continue;
          }
        EXPECT_EQ(state.v(system.normal(i)), 0);
        EXPECT_TRUE(node == NodeState::slip ||
                    state.v.segment(first, nt).isZero(0));
      }
  }
} // namespace

TEST(ActiveSet, SolvesRandomProblemsExactly)
{
  int solved = 0, all = 0;
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const int tangents : {0, 1, 2, -1})
      for (const Eigen::Index n : {1, 5, 30, 120})
        for (unsigned int seed = 1; seed < 6; ++seed)
          {
            RandomOptions o;
            o.form                     = form;
            o.tangents                 = tangents;
            o.n_nodes                  = n;
            o.seed                     = seed;
            o.zero_mu                  = .1;
            const RandomProblem random = random_problem(o);
            ContactState        state  = unloaded(random.problem);
            const SolverReport  report = solve(random.problem, state);
            ++all;
            // It may cycle: then it says so, and never claims a solution.
            EXPECT_EQ(report.converged, report.reason.empty());
            if (!report.converged)
              continue;
            ++solved;
            EXPECT_LE(contact_residual(random.problem, state), 1e-10);
            expect_exact_zeros(*random.problem.system, state);
          }
  EXPECT_GE(solved, (9 * all) / 10);
}

TEST(ActiveSet, OneStepFromTheRightStates)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    {
      RandomOptions o;
      o.form                     = form;
      o.tangents                 = 1;
      o.n_nodes                  = 50;
      const RandomProblem random = random_problem(o);
      ContactState        state  = random.solution;
      state.r *= .9;
      const SolverReport report = solve(random.problem, state);
      EXPECT_TRUE(report.converged);
      EXPECT_EQ(report.iterations, 1u);
      EXPECT_LT((state.r - random.solution.r).norm(), 1e-12);
      EXPECT_LT((state.v - random.solution.v).norm(), 1e-12);
    }
}

TEST(ActiveSet, LoadThatHasNotChangedTakesNoStep)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const int tangents : {0, 1, 2})
      {
        RandomOptions o;
        o.form                     = form;
        o.tangents                 = tangents;
        o.n_nodes                  = 60;
        const RandomProblem random = random_problem(o);
        ContactState        state  = unloaded(random.problem);
        const auto          solver = make_active_set({});
        ASSERT_TRUE(solver->solve(random.problem, state).converged);

        const Eigen::VectorXd r       = state.r;
        const ContactProblem  same    = next_increment(random.problem, state);
        const SolverReport    nothing = solver->solve(same, state);
        EXPECT_TRUE(nothing.converged);
        EXPECT_EQ(nothing.iterations, 0u);
        EXPECT_EQ(nothing.factorizations, 0u);
        EXPECT_EQ(state.r, r);
        EXPECT_LE(contact_residual(same, state), 1e-12);
        expect_exact_zeros(*random.problem.system, state);
      }
}

TEST(ActiveSet, LoadThatIsALittleBetterTakesOneStep)
{
  RandomOptions o;
  o.tangents             = 1;
  o.n_nodes              = 60;
  ContactProblem problem = random_problem(o).problem;
  const auto     solver  = make_active_set({});
  ContactState   state   = unloaded(problem);
  ASSERT_TRUE(solver->solve(problem, state).converged);
  problem.load *= 1 + 1e-9;
  state                     = unloaded(problem);
  const SolverReport report = solver->solve(problem, state);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 1u);
}

TEST(ActiveSet, LoadThatGoesOnTakesOneStep)
{
  // More of the same load after the first, which fixes who slips and sticks.
  for (const Form form : {Form::stiffness, Form::compliance})
    {
      RandomOptions o;
      o.form                        = form;
      o.tangents                    = 1;
      o.n_nodes                     = 60;
      o.open                        = 0;
      const RandomProblem   first   = random_problem(o);
      const Eigen::VectorXd step    = .1 * first.problem.load;
      ContactProblem        problem = first.problem;
      ContactState          state   = unloaded(problem);
      const auto            solver  = make_active_set({});
      ASSERT_TRUE(solver->solve(problem, state).converged);
      for (int k = 0; k < 4; ++k)
        {
          problem = next_increment(problem, state);
          problem.load += step;
          const SolverReport report = solver->solve(problem, state);
          EXPECT_TRUE(report.converged);
          EXPECT_LE(report.iterations, 1u);
          EXPECT_LE(contact_residual(problem, state), 1e-12);
        }
    }
}

TEST(ActiveSet, LoadThatTurnsDoesNotGoOn)
{
  ContactState start, end;
  start.v = start.r = Eigen::Vector2d(0, 1);
  end.v             = Eigen::Vector2d(.5, 0);
  end.r             = Eigen::Vector2d(-1, 3);
  const Eigen::Vector2d change(1, 0), across(0, 1);
  Predictor             predictor;
  EXPECT_FALSE(predictor.turns(start, change));
  predictor.remember(start, end, change);
  ContactState next = end;
  EXPECT_FALSE(predictor.turns(next, change));
  EXPECT_FALSE(predictor.turns(next, change + across));
  EXPECT_TRUE(predictor.turns(next, .3 * change + across));
  EXPECT_TRUE(predictor.turns(next, -change));
  next.r *= 2; // nothing is known of what led there
  EXPECT_FALSE(predictor.turns(next, -change));
}



TEST(ActiveSet, FloatingBodyFliesAway)
{
  // Two nodes joined by a spring along the normal, pulled off the ground.
  auto system    = std::make_shared<ContactSystem>();
  system->first  = {0, 1, 2};
  system->matrix = (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  system->mu     = Eigen::VectorXd::Zero(2);
  ContactProblem problem;
  problem.system            = system;
  problem.load              = Eigen::Vector2d(.1, .2);
  problem.gap               = Eigen::VectorXd::Zero(2);
  ContactState       state  = unloaded(problem);
  const SolverReport report = solve(problem, state);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
}

TEST(ActiveSet, RigidTableOnFourLegs)
{
  // W has rank 3: how four legs share the load is not determined, yet any
  // equilibrium will do.
  Eigen::MatrixXd G(4, 3);
  G << 1, 1, 1, 1, 1, -1, 1, -1, -1, 1, -1, 1;
  auto system    = std::make_shared<ContactSystem>();
  system->form   = Form::compliance;
  system->first  = {0, 1, 2, 3, 4};
  system->matrix = G * G.transpose();
  system->mu     = Eigen::VectorXd::Zero(4);
  ContactProblem problem;
  problem.system            = system;
  problem.load              = -G * Eigen::Vector3d(4, .5, .25);
  problem.gap               = Eigen::VectorXd::Zero(4);
  ContactState       state  = unloaded(problem);
  const SolverReport report = solve(problem, state);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(state.r.sum(), 4, 1e-12);
}

TEST(ActiveSet, MotionsFollowFromBalance)
{
  for (const int tangents : {0, 1, 2})
    for (const unsigned int seed : {1, 2, 3})
      for (const double drift : {0., 1., 1e3})
        {
          RandomOptions o;
          o.form                     = Form::compliance;
          o.tangents                 = tangents;
          o.n_nodes                  = 40;
          o.motions                  = 3;
          o.mu_max                   = .3;
          o.drift                    = drift;
          o.seed                     = seed;
          const RandomProblem random = random_problem(o);
          ContactState        state  = random.solution;
          state.r.head(state.r.size() - 3) *= .9;
          const SolverReport report = solve(random.problem, state);
          EXPECT_TRUE(report.converged) << report.reason;
          EXPECT_LT(
            (state.r - random.solution.r).head(state.r.size() - 3).norm(),
            1e-11 * std::max(1., drift));
        }
}
