// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/gauss_seidel.h"
#include "conetact/solvers/local_coulomb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace conetact;
using namespace conetact::solvers;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  std::mt19937 generator(7);

  double
  uniform(const double low, const double high)
  {
    return std::uniform_real_distribution<double>(low, high)(generator);
  }

  MatrixXd
  random_matrix(const Eigen::Index rows, const Eigen::Index columns)
  {
    return MatrixXd::NullaryExpr(rows, columns, [] { return uniform(-1, 1); });
  }

  std::shared_ptr<ContactSystem>
  make_system(const Form      form,
              const MatrixXd &matrix,
              const int       dim,
              const double    mu)
  {
    auto system    = std::make_shared<ContactSystem>();
    system->form   = form;
    system->matrix = matrix;
    for (Eigen::Index i = dim; i <= matrix.rows(); i += dim)
      system->first.push_back(i);
    system->mu = VectorXd::Constant(system->n_nodes(), mu);
    return system;
  }

  ContactProblem
  make_problem(const std::shared_ptr<ContactSystem> &system,
               const VectorXd                       &load)
  {
    ContactProblem problem;
    problem.system = system;
    problem.load   = load;
    problem.gap    = VectorXd::Zero(system->n_nodes());
    return problem;
  }

  SolverReport
  solve(const ContactProblem &problem,
        ContactState         &state,
        const double          tolerance  = 1e-10,
        const unsigned int    max_sweeps = 20000)
  {
    SolverOptions options;
    options.tolerance  = tolerance;
    options.max_sweeps = max_sweeps;
    return make_gauss_seidel(options)->solve(problem, state);
  }
} // namespace



TEST(LocalCoulomb, SolvesEveryBlockExactly)
{
  for (const double mu :
       {0., 1e-3, .01, .1, .3, .5, 1., 1.5, 3., 10., 30., 100.})
    for (const int dim : {1, 2, 3})
      for (const double condition : {1., 1e3, 1e6})
        for (int sample = 0; sample < 100; ++sample)
          for (const Form form : {Form::stiffness, Form::compliance})
            {
              const Eigen::HouseholderQR<MatrixXd> qr(random_matrix(dim, dim));
              const MatrixXd                       Q = qr.householderQ();
              VectorXd diagonal                      = VectorXd::Ones(dim);
              diagonal[0]                            = 1 / condition;
              const MatrixXd block = Q * diagonal.asDiagonal() * Q.transpose();
              const auto     problem =
                make_problem(make_system(form, block, dim, mu),
                             random_matrix(dim, 1));
              LocalCoulomb::Vector v, r;
              LocalCoulomb(form, block, mu, 1).solve(problem.load, v, r);
              const ContactState state{v, r, {}};
              const double       error = contact_residual(problem, state);
              // v and r of very different size: round-off grows with it
              const double ratio = r.norm() > 0 ? v.norm() / r.norm() : 1.;
              ASSERT_LT(error, 1e-13 * condition * std::max(1., ratio))
                << mu << " " << dim << " " << condition << " " << int(form)
                << "\n"
                << block << "\n"
                << problem.load.transpose();
            }
}



TEST(LocalCoulomb, UnsymmetricCompliances)
{
  for (const double mu : {0., .01, .3, 1., 3.})
    for (const int dim : {2, 3})
      for (const double skew : {1e-5, 1e-3, 1e-1})
        for (int sample = 0; sample < 200; ++sample)
          {
            const MatrixXd A = random_matrix(dim, 2 * dim),
                           B = random_matrix(dim, dim);
            const MatrixXd block =
              A * A.transpose() / dim + skew * (B - B.transpose());
            const auto problem =
              make_problem(make_system(Form::compliance, block, dim, mu),
                           random_matrix(dim, 1));
            LocalCoulomb::Vector v, r;
            LocalCoulomb(Form::compliance, block, mu, 1)
              .solve(problem.load, v, r);
            ASSERT_LT(contact_residual(problem, {v, r, {}}), 1e-10)
              << mu << " " << dim << " " << skew << "\n"
              << block << "\n"
              << problem.load.transpose();
          }
}



TEST(LocalCoulomb, SingularBlocksDoNotHarm)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const int dim : {1, 2, 3})
      for (int rank = 0; rank < dim; ++rank)
        {
          const MatrixXd       A     = random_matrix(dim, rank);
          const MatrixXd       block = A * A.transpose();
          LocalCoulomb::Vector v, r;
          LocalCoulomb(form, block, .5, 1).solve(random_matrix(dim, 1), v, r);
          EXPECT_TRUE(v.allFinite() && r.allFinite());
        }
}



TEST(LocalCoulomb, KnownSlip)
{
  // unit stiffness, pressed by 2, pushed by (3, 4): slips along the push
  LocalCoulomb::Vector v, r, q(3);
  q << 3, 4, -2;
  LocalCoulomb(Form::stiffness, Eigen::Matrix3d::Identity(), .5, 1)
    .solve(q, v, r);
  EXPECT_NEAR(r[2], 2, 1e-14);
  EXPECT_NEAR(r[0], -.6, 1e-14);
  EXPECT_NEAR(r[1], -.8, 1e-14);
  EXPECT_NEAR(v[0], 2.4, 1e-14);
  EXPECT_NEAR(v[1], 3.2, 1e-14);
  EXPECT_EQ(v[2], 0);
}



TEST(GaussSeidel, RandomDefiniteProblems)
{
  int solved = 0, total = 0;
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const int dim : {2, 3})
      for (const double mu : {0., .2, .5, .9})
        for (const int n_c : {1, 5, 30})
          {
            const Eigen::Index n = dim * n_c;
            const MatrixXd     A = random_matrix(n, n + n / 2 + 5);
            const auto         problem =
              make_problem(make_system(form, A * A.transpose(), dim, mu),
                           random_matrix(n, 1));
            ContactState       state;
            const SolverReport report = solve(problem, state);
            ++total;
            solved += report.converged;
            if (report.converged)
              {
                EXPECT_LE(contact_residual(problem, state), 1e-10);
                EXPECT_EQ(state.node.size(), static_cast<std::size_t>(n_c));
              }
            else
              EXPECT_FALSE(report.reason.empty());
          }
  EXPECT_GE(solved, total - 2);
}



TEST(GaussSeidel, BothFormsAgree)
{
  const Eigen::Index n = 30;
  const MatrixXd     A = random_matrix(n, 2 * n);
  const MatrixXd     K = A * A.transpose(), W = K.inverse();
  const VectorXd     f = random_matrix(n, 1);
  ContactState       one, two;
  ASSERT_TRUE(
    solve(make_problem(make_system(Form::stiffness, K, 3, .3), f), one, 1e-13)
      .converged);
  ASSERT_TRUE(
    solve(make_problem(make_system(Form::compliance, W, 3, .3), W * f),
          two,
          1e-13)
      .converged);
  EXPECT_LT((one.r - two.r).norm(), 1e-9 * one.r.norm());
  EXPECT_LT((one.v - two.v).norm(), 1e-9 * one.v.norm());
}



TEST(GaussSeidel, RedundantContactsOfARigidBody)
{
  // a rigid block of unit mass on nine nodes: W has rank six
  const int dim = 3;
  MatrixXd  H(27, 6);
  for (int i = 0; i < 9; ++i)
    {
      const Eigen::Vector3d x(i % 3 - 1, i / 3 - 1, -.5);
      for (int j = 0; j < 3; ++j)
        H.row(3 * i + j) << Eigen::Vector3d::Unit(j).transpose(),
          x.cross(Eigen::Vector3d::Unit(j)).transpose();
    }
  for (const double push : {.2, .7})
    {
      VectorXd load(6);
      load << push, 0, -1, 0, 0, 0;
      const auto problem =
        make_problem(make_system(Form::compliance, H * H.transpose(), dim, .5),
                     H * load);
      ContactState       state;
      const SolverReport report = solve(problem, state);
      ASSERT_TRUE(report.converged) << report.reason;
      const VectorXd resultant = H.transpose() * state.r;
      EXPECT_NEAR(resultant[2], 1, 1e-9);
      EXPECT_NEAR(resultant[0], -std::min(push, .5), 1e-9);
    }
}



TEST(GaussSeidel, MixedNodesAndWarmStart)
{
  // nodes with no, one and two tangents
  auto system      = std::make_shared<ContactSystem>();
  system->first    = {0, 1, 3, 6, 7, 9, 12};
  system->mu       = VectorXd::Constant(6, .4);
  system->mu[2]    = 0;
  const MatrixXd A = random_matrix(12, 30);
  system->matrix   = A * A.transpose();
  auto problem     = make_problem(system, random_matrix(12, 1));
  for (Eigen::Index i = 0; i < 6; ++i)
    problem.load[system->normal(i)] -= 2; // presses
  ContactState state;
  const auto   cold = solve(problem, state, 1e-12);
  ASSERT_TRUE(cold.converged) << cold.reason;
  const VectorXd r    = state.r;
  const auto     warm = solve(problem, state, 1e-12);
  EXPECT_TRUE(warm.converged);
  EXPECT_LE(warm.iterations, cold.iterations);
  EXPECT_LT((state.r - r).norm(), 1e-10 * r.norm());
}



TEST(GaussSeidel, UnitsDoNotMatter)
{
  const Eigen::Index n = 24;
  const MatrixXd     A = random_matrix(n, 2 * n);
  const VectorXd     f = random_matrix(n, 1);
  ContactState       state;
  const auto         iterations =
    solve(make_problem(make_system(Form::stiffness, A * A.transpose(), 3, .3),
                       f),
          state)
      .iterations;
  // powers of two: the arithmetic is then the same to the bit
  for (const double force : {std::ldexp(1., -30), std::ldexp(1., 30)})
    for (const double length : {std::ldexp(1., -30), std::ldexp(1., 30)})
      {
        ContactState       scaled;
        const SolverReport report =
          solve(make_problem(make_system(Form::stiffness,
                                         force / length * A * A.transpose(),
                                         3,
                                         .3),
                             force * f),
                scaled);
        EXPECT_TRUE(report.converged);
        EXPECT_EQ(report.iterations, iterations);
        EXPECT_EQ(scaled.r, force * state.r);
      }
}



TEST(GaussSeidel, HonestAboutFailure)
{
  // pulled up with nothing to hold it
  MatrixXd K(2, 2);
  K << 1, -1, -1, 1;
  VectorXd f(2);
  f << 1, 1;
  ContactState       state;
  const SolverReport report = solve(
    make_problem(make_system(Form::stiffness, K, 1, 0), f), state, 1e-10, 100);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_GT(report.residual, 1e-10);
}



TEST(GaussSeidel, GoesOnForTwoDigitsMore)
{
  const MatrixXd A = MatrixXd::Identity(9, 9) + .1 * MatrixXd::Ones(9, 9);
  VectorXd       f(9);
  f << 1, 2, -3, 2, -1, -2, -1, 1, -4;
  ContactState       state;
  const SolverReport report =
    solve(make_problem(make_system(Form::stiffness, A, 3, .3), f), state);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.residual, 1e-12);
}
