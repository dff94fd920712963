// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/active_set.h"
#include "conetact/solvers/dense_operator.h"
#include "conetact/solvers/large_newton.h"
#include "conetact/solvers/large_operator.h"
#include "conetact/solvers/local_system.h"

#include <gtest/gtest.h>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  /** A dense one: a Schur complement with unknowns in front of it. */
  class DenseSystem : public LocalSystem
  {
  public:
    DenseSystem(const Eigen::MatrixXd &S, const Eigen::Index n_free)
      : K(Eigen::MatrixXd::Zero(n_free + S.rows(), n_free + S.rows()))
      , m(n_free)
    {
      internal::Random      random(7);
      const Eigen::MatrixXd B =
        internal::random_matrix(random, m, m + S.rows());
      K.topRows(m)          = B;
      K.topLeftCorner(m, m) = B.leftCols(m) * B.leftCols(m).transpose() +
                              Eigen::MatrixXd::Identity(m, m);
      K.bottomLeftCorner(S.rows(), m) = B.rightCols(S.rows()).transpose();
      K.bottomRightCorner(S.rows(), S.rows()) =
        S + K.bottomLeftCorner(S.rows(), m) *
              K.topLeftCorner(m, m).ldlt().solve(K.topRightCorner(m, S.rows()));
    }
    Eigen::Index
    n_unknowns() const override
    {
      return K.rows();
    }
    Kept
    multiply(const Kept &u) const override
    {
      return keep(K * array(u));
    }
    Array
    diagonal() const override
    {
      return K.diagonal();
    }
    std::optional<Step>
    solve(const std::vector<NodeLaw> &laws,
          const Kept                 &f,
          const Precision            &precision) const override
    {
      Eigen::MatrixXd A     = K;
      Array           b     = -array(f);
      Index           first = m;
      for (const NodeLaw &law : laws)
        {
          const Index n          = law.h.size();
          A.middleRows(first, n) = law.d * K.middleRows(first, n);
          A.block(first, first, n, n) += law.p;
          b.segment(first, n) = law.h;
          first += n;
        }
      // as inexact as it may be
      const Array du =
        (1 + .5 * precision.relative) * A.partialPivLu().solve(b);
      return Step{keep(du), 1, precision.relative};
    }
    Index
    n_contact_unknowns() const override
    {
      return K.rows() - m;
    }

    Eigen::MatrixXd K;
    Eigen::Index    m;
  };

  /** The same problem with more unknowns, under loads on them, too. */
  ContactProblem
  enlarged(const ContactProblem &problem, const Eigen::Index m)
  {
    auto system            = std::make_shared<ContactSystem>(*problem.system);
    auto large             = std::make_shared<DenseSystem>(system->matrix, m);
    system->large          = large;
    const Eigen::Index n   = system->n_unknowns();
    system->large_diagonal = large->diagonal().tail(n);
    ContactProblem        result = problem;
    const Eigen::VectorXd b_F    = Eigen::VectorXd::LinSpaced(m, -1, 1);
    result.load.resize(m + n);
    result.load << b_F,
      problem.load + large->K.bottomLeftCorner(n, m) *
                       large->K.topLeftCorner(m, m).ldlt().solve(b_F);
    if (result.offset.size() == 0)
      result.offset = Eigen::VectorXd::Zero(n);
    system->matrix.resize(0, 0);
    result.system = system;
    return result;
  }

  ContactState
  start_of(const ContactProblem &problem)
  {
    const ContactSystem &system = *problem.system;
    ContactState         state;
    state.v = state.r = Eigen::VectorXd::Zero(system.n_unknowns());
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      state.v(system.normal(i)) = problem.gap(i);
    state.u = Eigen::VectorXd::Zero(problem.load.size());
    if (system.large)
      state.u.tail(system.n_unknowns()) = state.v - problem.offset;
    return state;
  }
} // namespace

TEST(LargeNewton, FindsWhatTheCondensedProblemHas)
{
  for (unsigned int seed = 1; seed <= 20; ++seed)
    {
      RandomOptions options;
      options.n_nodes            = 12;
      options.tangents           = seed % 2 == 0 ? 2 : 1;
      options.mu_max             = .5;
      options.seed               = seed;
      const RandomProblem random = random_problem(options);
      ContactState        small  = start_of(random.problem);
      small.u.resize(0);
      ASSERT_TRUE(ActiveSet({}).solve(random.problem, small).converged);

      const ContactProblem problem = enlarged(random.problem, 30);
      ContactState         state   = start_of(problem);
      const SolverReport   report  = LargeNewton({}).solve(problem, state);
      ASSERT_TRUE(report.converged) << seed << ": " << report.reason;
      EXPECT_LT((state.r - small.r).norm(), 1e-9 * small.r.norm()) << seed;
      EXPECT_LT((state.v - small.v).norm(), 1e-9 * small.v.norm()) << seed;
      EXPECT_EQ(state.node, small.node) << seed;
      EXPECT_EQ(state.u.size(), problem.load.size());
    }
}

TEST(LargeNewton, TakesNoStepUnderTheSameLoad)
{
  const ContactProblem first = enlarged(random_problem({}).problem, 10);
  ContactState         state = start_of(first);
  LargeNewton          newton({});
  ASSERT_TRUE(newton.solve(first, state).converged);
  const ContactSystem &system = *first.system;
  ContactProblem       again  = first;
  ContactState         start  = state;
  for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
    {
      const Eigen::Index nt = system.n_tangents(i);
      again.offset.segment(system.first[static_cast<std::size_t>(i)], nt) -=
        state.v.segment(system.first[static_cast<std::size_t>(i)], nt);
      start.v.segment(system.first[static_cast<std::size_t>(i)], nt).setZero();
      again.gap(i) = state.v(system.normal(i));
    }
  // what slipped sticks now: states need not be the same, but nothing moves
  const SolverReport report = newton.solve(again, start);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_EQ(report.iterations, 0u);
  EXPECT_EQ(report.krylov, 0u);
}

TEST(LargeNewton, DoesWhatItCannotSolveAtOnceInParts)
{
  SolverOptions options;
  options.max_iterations = 2; // too few for all of it
  RandomOptions what;
  what.n_nodes                 = 8;
  what.mu_max                  = .3;
  const ContactProblem problem = enlarged(random_problem(what).problem, 10);
  ContactState         state   = start_of(problem);
  const SolverReport   report  = LargeNewton(options).solve(problem, state);
  if (report.converged)
    EXPECT_LE(report.residual, options.tolerance);
  else
    EXPECT_FALSE(report.reason.empty());
}

/** A step in the plane is the same whether a system has a matrix of its contact
 * unknowns or keeps all of its unknowns. In space what turns slips is made
 * definite for large systems. */
TEST(LinearOperators, TakeTheSameStep)
{
  for (unsigned int seed = 1; seed <= 10; ++seed)
    {
      RandomOptions options;
      options.n_nodes            = 9;
      options.tangents           = 1;
      options.mu_max             = .5;
      options.seed               = seed;
      const RandomProblem random = random_problem(options);
      DenseOperator       dense(random.problem.system);
      dense.set_load(random.problem);
      const ContactProblem enlarged_problem = enlarged(random.problem, 12);
      LargeOperator        large(enlarged_problem.system, 1e-10);
      large.set_load(enlarged_problem);

      ContactState small = start_of(random.problem);
      small.u.resize(0);
      Eigen::VectorXd p, d;
      dense.relation().to_scaled(small, p, d);
      NewtonPoint        a     = dense.point_at(p), b;
      const ContactState start = start_of(enlarged_problem);
      b                        = large.point_at(large.body().keep(start.u));
      a.sets = b.sets = sets_of_state(dense.relation(), small);
      for (int i = 0; i < 3; ++i) // the first one sticks everywhere
        {
          SolverReport report;
          const auto   to_a = dense.step(a.sets, a, 0, report);
          const auto   to_b = large.step(b.sets, b, 1e-14, report);
          ASSERT_TRUE(to_a && to_b);
          ContactState s, t;
          dense.write(*to_a, s);
          large.write(*to_b, t);
          EXPECT_LE((s.r - t.r).norm(), 1e-9 * s.r.norm()) << seed;
          EXPECT_LE((s.v - t.v).norm(), 1e-9 * s.v.norm()) << seed;
          EXPECT_LT(to_b->balance, 1e-9);
          a      = *to_a;
          b      = *to_b;
          a.sets = b.sets = sets_of_point(dense.relation(), a.p, a.d);
        }
    }
}
