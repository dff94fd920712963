// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/all_solutions.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

using namespace conetact::solvers;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  /** Of n nodes with any definite matrix, in either form. */
  ContactProblem
  any_problem(std::mt19937 &random,
              const int     n,
              const double  mu,
              const bool    stiffness)
  {
    std::normal_distribution<double> normal;
    const auto                       any = [&] { return normal(random); };
    const MatrixXd L = MatrixXd::NullaryExpr(2 * n, 2 * n, any);
    const MatrixXd W =
      L * L.transpose() + .05 * MatrixXd::Identity(2 * n, 2 * n);
    const MatrixXd K      = W.inverse();
    auto           system = std::make_shared<ContactSystem>();
    system->form          = stiffness ? Form::stiffness : Form::compliance;
    system->matrix        = stiffness ? MatrixXd(.5 * (K + K.transpose())) : W;
    for (int i = 0; i < n; ++i)
      system->first.push_back(2 * i + 2);
    system->mu = VectorXd::Constant(n, mu);
    ContactProblem problem;
    problem.system   = system;
    const VectorXd q = VectorXd::NullaryExpr(2 * n, any);
    problem.load     = stiffness ? VectorXd(K * q) : q;
    problem.gap      = VectorXd::Zero(n);
    return problem;
  }

  /** Reactions of all sets of states that obey the law, one by one. */
  std::vector<VectorXd>
  by_brute_force(const ContactProblem &problem)
  {
    const ContactSystem &system = *problem.system;
    const bool           stiff  = system.form == Form::stiffness;
    const MatrixXd       W =
      stiff ? MatrixXd(system.matrix.inverse()) : system.matrix;
    const VectorXd        q = stiff ? VectorXd(W * problem.load) : problem.load;
    const Eigen::Index    n = system.n_nodes();
    std::vector<VectorXd> found;
    for (long code = 0; code < 1L << (2 * n); ++code)
      {
        const auto state = [&](const Eigen::Index i) {
          return (code >> (2 * i)) & 3;
        };
        MatrixXd   A    = MatrixXd::Zero(2 * n, 2 * n);
        VectorXd   b    = VectorXd::Zero(2 * n);
        const auto stop = [&](const Eigen::Index k) {
          A.row(k) = W.row(k);
          b(k)     = -q(k);
        };
        for (Eigen::Index i = 0; i < n; ++i)
          {
            const Eigen::Index t = 2 * i, m = t + 1;
            if (state(i) == 0)
              A(t, t) = A(m, m) = 1;
            else
              stop(m);
            if (state(i) == 1)
              stop(t);
            else if (state(i) > 1)
              {
                A(t, t) = 1;
                A(t, m) = state(i) == 2 ? system.mu(i) : -system.mu(i);
              }
          }
        const VectorXd   r = A.fullPivLu().solve(b), v = W * r + q;
        constexpr double e  = 1e-9;
        bool             ok = true;
        for (Eigen::Index i = 0; i < n; ++i)
          {
            const double limit = system.mu(i) * r(2 * i + 1);
            ok                 = ok && r(2 * i + 1) > -e && v(2 * i + 1) > -e &&
                 (state(i) != 1 || std::abs(r(2 * i)) < limit + e) &&
                 (state(i) != 2 || v(2 * i) > -e) &&
                 (state(i) != 3 || v(2 * i) < e);
          }
        const bool known =
          std::any_of(found.begin(), found.end(), [&](const VectorXd &o) {
            return (o - r).norm() < 1e-6;
          });
        if (ok && !known)
          found.push_back(r);
      }
    return found;
  }
} // namespace

TEST(AllSolutions, AreThoseOfAllSetsOfStates)
{
  std::mt19937 random(5);
  unsigned int several = 0;
  for (int trial = 0; trial < 600; ++trial)
    {
      const int            n       = 1 + trial % 4;
      const double         mu      = .02 * (trial % 150);
      const ContactProblem problem = any_problem(random, n, mu, trial % 3 == 0);
      ASSERT_TRUE(has_finite_solutions(problem));
      const AllSolutions all   = find_all_solutions(problem, 1e-8);
      const auto         right = by_brute_force(problem);
      EXPECT_EQ(all.open, "");
      ASSERT_EQ(all.found.size(), right.size()) << "trial " << trial;
      for (const ContactState &state : all.found)
        EXPECT_TRUE(
          std::any_of(right.begin(), right.end(), [&](const VectorXd &r) {
            return (r - state.r).norm() < 1e-6 * std::max(1., r.norm());
          }));
      several += right.size() > 1;
    }
  EXPECT_GT(several, 0u);
}

// Thirty nodes of an elastic half plane take some hundred sets, not 4^30.
TEST(AllSolutions, LeaveMostSetsOut)
{
  constexpr int n      = 30;
  auto          system = std::make_shared<ContactSystem>();
  system->form         = Form::compliance;
  system->matrix       = 1e-3 * MatrixXd::Identity(2 * n, 2 * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      {
        const double far = 1. + std::abs(i - j), sign = (i < j) - (i > j);
        system->matrix.block<2, 2>(2 * i, 2 * j) +=
          (Eigen::Matrix2d() << 1, .15 * sign, -.15 * sign, 1).finished() / far;
      }
  for (int i = 0; i < n; ++i)
    system->first.push_back(2 * i + 2);
  system->mu = VectorXd::Constant(n, .3);
  ContactProblem problem;
  problem.system = system;
  problem.gap    = VectorXd::Zero(n);
  problem.load   = VectorXd::Zero(2 * n);
  for (int i = 0; i < n; ++i)
    {
      problem.load(2 * i)     = .2 + .1 * std::sin(7 * i);
      problem.load(2 * i + 1) = -1 + .3 * std::cos(5 * i);
    }
  const AllSolutions all = find_all_solutions(problem, 1e-9);
  EXPECT_EQ(all.open, "");
  EXPECT_EQ(all.found.size(), 1u);
  EXPECT_LT(all.n_tried, 1000u);
}
