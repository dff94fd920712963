// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/process.h"
#include "conetact/condensed/condenser.h"
#include "conetact/condensed/mumps_schur.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lattice.h"

namespace
{
  using conetact::Lattice;
  using conetact::ProcessSession;
  using conetact::System;
  using conetact::condensed::Condenser;
  using conetact::condensed::condenser_table;
  using conetact::condensed::MumpsSchur;
  using Eigen::Index;
  using Eigen::MatrixXd;
  using LongMatrix   = Eigen::Matrix<long double, -1, -1>;
  using SparseMatrix = Eigen::SparseMatrix<double>;

  MatrixXd
  dense(const SparseMatrix &upper)
  {
    return MatrixXd(upper).selfadjointView<Eigen::Upper>();
  }

  LongMatrix
  exact_schur_complement(const MatrixXd &matrix, const Index n_schur)
  {
    const LongMatrix A = matrix.cast<long double>();
    const Index      f = A.cols() - n_schur;
    return A.bottomRightCorner(n_schur, n_schur) -
           A.bottomLeftCorner(n_schur, f) *
             A.topLeftCorner(f, f).llt().solve(A.topRightCorner(f, n_schur));
  }

  double
  relative_difference(const LongMatrix &a, const LongMatrix &b)
  {
    return static_cast<double>((a - b).norm() / b.norm());
  }

  // S, reduce and expand against dense algebra in long double.
  void
  check_against_dense(const Condenser &condenser,
                      const System    &system,
                      const Index      n_schur,
                      const double     tolerance)
  {
    const MatrixXd A = dense(system.upper);
    const Index    n = A.cols(), f = n - n_schur;
    const auto solver = condenser.create(system.upper, n_schur, system.node_of);
    const MatrixXd S  = solver->take_schur_complement();
    ASSERT_EQ(S.rows(), n_schur);
    ASSERT_EQ(S.cols(), n_schur);
    if (n_schur > 0)
      {
        EXPECT_LT(relative_difference(S.cast<long double>(),
                                      exact_schur_complement(A, n_schur)),
                  tolerance);
        EXPECT_EQ((S - S.transpose()).norm(), 0.);
      }

    // more columns than are treated at once
    const Index      k       = 131;
    const MatrixXd   b       = MatrixXd::Random(n, k);
    const MatrixXd   u_C     = MatrixXd::Random(n_schur, k);
    const LongMatrix A_long  = A.cast<long double>();
    const auto       A_FF    = A_long.topLeftCorner(f, f).llt();
    const MatrixXd   reduced = solver->reduce(b);
    ASSERT_EQ(reduced.rows(), n_schur);
    ASSERT_EQ(reduced.cols(), k);
    if (n_schur > 0)
      {
        LongMatrix expected = b.bottomRows(n_schur).cast<long double>();
        if (f > 0)
          expected -= A_long.bottomLeftCorner(n_schur, f) *
                      A_FF.solve(b.topRows(f).cast<long double>());
        EXPECT_LT(relative_difference(reduced.cast<long double>(), expected),
                  tolerance);
      }
    const MatrixXd u = solver->expand(b, u_C);
    EXPECT_EQ((u.bottomRows(n_schur) - u_C).norm(), 0.);
    if (f > 0)
      {
        const LongMatrix load =
          b.topRows(f).cast<long double>() -
          A_long.topRightCorner(f, n_schur) * u_C.cast<long double>();
        EXPECT_LT(relative_difference(u.topRows(f).cast<long double>(),
                                      A_FF.solve(load)),
                  tolerance);
      }
  }

  void
  check_against_dense(const System &system,
                      const Index   n_schur,
                      const double  tolerance = 1e-13)
  {
    for (const Condenser &condenser : condenser_table())
      {
        SCOPED_TRACE(condenser.name);
        check_against_dense(condenser, system, n_schur, tolerance);
      }
  }
} // namespace



TEST(SchurSolver, AgreesWithDenseAlgebra)
{
  check_against_dense(Lattice{{12, 9}}.assemble(), 24);
  check_against_dense(Lattice{{5, 6, 5}}.assemble(), 90);
  check_against_dense(Lattice{{3, 3, 8}}.assemble(), 27);
}



TEST(SchurSolver, TakesAnyNumberOfSchurUnknowns)
{
  const System system = Lattice{{4, 5}}.assemble();
  const Index  n      = system.upper.cols();
  for (const Index n_schur : {0, 1, 2, 3, 20, 37, 38, 39, 40})
    check_against_dense(system, n_schur);
  EXPECT_EQ(n, 40);
}



TEST(SchurSolver, TakesTinySystems)
{
  for (Index n = 1; n < 5; ++n)
    {
      System system;
      system.upper.resize(n, n);
      for (Index i = 0; i < n; ++i)
        {
          system.upper.insert(i, i) = 2. + static_cast<double>(i);
          if (i > 0)
            system.upper.insert(i - 1, i) = -1.;
          system.node_of.push_back(4000000000U + static_cast<unsigned int>(i));
        }
      for (Index n_schur = 0; n_schur <= n; ++n_schur)
        check_against_dense(system, n_schur);
    }
}



TEST(SchurSolver, TakesUncoupledUnknownsAndAnEmptyMatrix)
{
  System system;
  system.upper.resize(7, 7);
  system.upper.setIdentity();
  system.upper *= 3.;
  system.node_of = {0, 0, 1, 2, 2, 3, 3};
  check_against_dense(system, 0);
  check_against_dense(system, 4);
  for (const Condenser &condenser : condenser_table())
    {
      const auto none = condenser.create(SparseMatrix(0, 0), 0, {});
      EXPECT_EQ(none->take_schur_complement().size(), 0);
      EXPECT_EQ(none->reduce(MatrixXd(0, 3)).cols(), 3);
      EXPECT_EQ(none->expand(MatrixXd(0, 3), MatrixXd(0, 3)).cols(), 3);
    }
}



// A contact node may keep one of its unknowns among the eliminated ones, and
// unknowns of a node need not stand together.
TEST(SchurSolver, TakesNodesOnBothSides)
{
  const System                        by_node = Lattice{{5, 4}}.assemble();
  const Index                         n       = by_node.upper.cols();
  System                              system; // all x, then all y
  std::vector<Eigen::Triplet<double>> entries;
  const auto place = [n](const Index i) { return (i % 2) * (n / 2) + i / 2; };
  for (Index column = 0; column < n; ++column)
    for (SparseMatrix::InnerIterator entry(by_node.upper, column); entry;
         ++entry)
      {
        const Index i = place(entry.row()), j = place(column);
        entries.emplace_back(std::min(i, j), std::max(i, j), entry.value());
      }
  system.upper.resize(n, n);
  system.upper.setFromTriplets(entries.begin(), entries.end());
  for (Index i = 0; i < n; ++i)
    system.node_of.push_back(static_cast<unsigned int>(i % (n / 2)));
  check_against_dense(system, 5);
  check_against_dense(system, 20);
  check_against_dense(system, 33);
}



namespace
{
  // A square membrane of n x n equal cells with one unknown a node; the rows at
  // its top are held by springs of stiffness 1. Forces of a cell add up to zero
  // exactly.
  System
  membrane(const Index n)
  {
    const double                        k = std::round(0x1p40 * 1.1) * 0x1p-40;
    std::vector<Eigen::Triplet<double>> entries;
    System                              system;
    const auto couple = [&](const Index i, const Index j) {
      entries.emplace_back(std::min(i, j), std::max(i, j), -k);
      entries.emplace_back(i, i, k);
      entries.emplace_back(j, j, k);
    };
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x)
        {
          const Index i = y * n + x;
          system.node_of.push_back(static_cast<unsigned int>(i));
          if (y == 0)
            entries.emplace_back(i, i, 1.);
          if (x + 1 < n)
            couple(i, i + 1);
          if (y + 1 < n)
            couple(i, i + n);
          if (x + 1 < n && y + 1 < n)
            {
              couple(i, i + n + 1);
              couple(i + 1, i + n);
            }
        }
    system.upper.resize(n * n, n * n);
    system.upper.setFromTriplets(entries.begin(), entries.end());
    return system;
  }
} // namespace



namespace
{
  void
  check_balance(const std::string &condenser, const Index n)
  {
    const System system = membrane(n);
    const auto   solver =
      conetact::condensed::condenser_named(condenser).create(system.upper,
                                                             n,
                                                             system.node_of);
    const MatrixXd u_C       = MatrixXd::Ones(n, 1);
    const MatrixXd u         = solver->expand(MatrixXd::Zero(n * n, 1), u_C);
    const double   at_bottom = (solver->take_schur_complement() * u_C).sum();
    const double   at_top    = u.topRows(n).sum();
    EXPECT_LT(std::abs(at_bottom - at_top), 2e-13 * at_top) << condenser;
  }
} // namespace



// Rounding errors of equal cells must not add up over the area.
TEST(SchurSolver, KeepsTheBalanceOfLargeMeshes)
{
  check_balance("mumps", 200);
  check_balance("amesos_klu", 100);
  check_balance("amesos_mumps", 100);
}



TEST(SchurSolver, TakesAMatrixThatIsNotCompressed)
{
  System system = Lattice{{4, 4}}.assemble();
  system.upper.uncompress();
  system.upper.reserve(Eigen::VectorXi::Constant(system.upper.cols(), 50));
  check_against_dense(system, 8);
}



// As Eigen leaves them where unknowns have changed their places.
TEST(SchurSolver, TakesRowsOfRetainedUnknownsInAnyOrder)
{
  System      system = Lattice{{4, 4}}.assemble();
  const Index n = system.upper.cols(), n_schur = 8;
  for (Index j = n - n_schur; j < n; ++j)
    {
      const int begin = system.upper.outerIndexPtr()[j];
      const int end   = system.upper.outerIndexPtr()[j + 1];
      std::reverse(system.upper.innerIndexPtr() + begin,
                   system.upper.innerIndexPtr() + end);
      std::reverse(system.upper.valuePtr() + begin,
                   system.upper.valuePtr() + end);
    }
  check_against_dense(system, n_schur);
}



TEST(SchurSolver, ReducesWithoutLoadsOnEliminatedUnknowns)
{
  const System system = Lattice{{4, 5}}.assemble();
  MatrixXd     b      = MatrixXd::Zero(40, 2);
  b.bottomRows(8).setRandom();
  for (const Condenser &condenser : condenser_table())
    {
      const auto solver = condenser.create(system.upper, 8, system.node_of);
      EXPECT_EQ(solver->reduce(b), b.bottomRows(8));
      EXPECT_EQ(
        solver->expand(MatrixXd::Zero(40, 1), MatrixXd::Zero(8, 1)).norm(), 0.);
    }
}



TEST(SchurSolver, SolverOutlivesItsMatrixAndItsSchurComplement)
{
  for (const Condenser &condenser : condenser_table())
    {
      auto       system = std::make_unique<System>(Lattice{{6, 6}}.assemble());
      const auto solver = condenser.create(system->upper, 12, system->node_of);
      const MatrixXd b  = MatrixXd::Random(72, 3);
      const MatrixXd expected = solver->reduce(b);
      system.reset();
      {
        const MatrixXd gone = solver->take_schur_complement();
      }
      EXPECT_EQ(solver->reduce(b), expected);
    }
}



// Rigid motions of a floating body stay null vectors of its Schur complement.
TEST(SchurSolver, KeepsNullVectors)
{
  Lattice lattice{{5, 5, 6}};
  lattice.shear        = 0.;
  lattice.support      = 0.;
  const System system  = lattice.assemble();
  const Index  n_schur = 75;
  MatrixXd     motions(n_schur, 6);
  for (Index i = 0; i < n_schur / 3; ++i)
    {
      const Eigen::Vector3d x =
        lattice.point(lattice.n_nodes() - n_schur / 3 + i);
      for (Index d = 0; d < 3; ++d)
        {
          const Eigen::Vector3d e           = Eigen::Vector3d::Unit(d);
          motions.block<3, 1>(3 * i, d)     = e;
          motions.block<3, 1>(3 * i, 3 + d) = e.cross(x);
        }
    }
  const LongMatrix exact = exact_schur_complement(dense(system.upper), n_schur);
  for (const Condenser &condenser : condenser_table())
    {
      const MatrixXd S =
        condenser.create(system.upper, n_schur, system.node_of)
          ->take_schur_complement();
      EXPECT_LT((S * motions).norm(), 3e-15 * S.norm() * motions.norm())
        << condenser.name;
      EXPECT_LT(relative_difference(S.cast<long double>(), exact), 1e-14)
        << condenser.name;
    }
}



TEST(SchurSolver, CountsItsWork)
{
  const System     system = Lattice{{6, 6}}.assemble();
  const Index      n = system.upper.cols(), n_schur = 12;
  const MumpsSchur solver(system.upper, n_schur, system.node_of);
  EXPECT_EQ(solver.work().factorizations, 1u);
  EXPECT_EQ(solver.work().condensations, 1u);
  const unsigned int before = solver.work().triangular_solves;

  solver.reduce(MatrixXd::Ones(n, 3));
  EXPECT_EQ(solver.work().reductions, 3u);
  EXPECT_EQ(solver.work().triangular_solves, before + 3);
  solver.expand(MatrixXd::Ones(n, 2), MatrixXd::Ones(n_schur, 2));
  EXPECT_EQ(solver.work().expansions, 2u);
  EXPECT_EQ(solver.work().triangular_solves, before + 3 + 4);
}



TEST(SchurSolver, EstimatesItsFactor)
{
  const System system = Lattice{{12, 12, 12}}.assemble();
  for (const Index n_schur : {Index(0), Index(3 * 144)})
    {
      const double bytes =
        MumpsSchur(system.upper, n_schur, system.node_of).factor_bytes();
      EXPECT_GT(bytes, 60 * sizeof(double));
      const auto estimate =
        MumpsSchur::estimate(system.upper, n_schur, system.node_of);
      EXPECT_GT(estimate.factor_bytes, .9 * bytes);
      EXPECT_LT(estimate.factor_bytes, 1.5 * bytes);
      EXPECT_GT(estimate.working_bytes, bytes);
      // columns of the factor with c entries take c^2 operations
      const double mean =
        std::pow(bytes / 8, 2) / static_cast<double>(system.upper.cols());
      EXPECT_GT(estimate.flops, mean);
      EXPECT_LT(estimate.flops, 5 * mean);
    }
}



TEST(SchurSolver, RefusesWrongInput)
{
  const System       system = Lattice{{3, 3}}.assemble();
  const SparseMatrix lower  = system.upper.transpose();
  for (const Condenser &condenser : condenser_table())
    {
      EXPECT_THROW(condenser.create(system.upper, 19, system.node_of),
                   std::invalid_argument);
      EXPECT_THROW(condenser.create(system.upper, 3, {0, 1}),
                   std::invalid_argument);
      EXPECT_THROW(condenser.create(lower, 6, system.node_of),
                   std::invalid_argument);
    }
}



TEST(SchurSolver, DoesNotDependOnTheNumberOfThreads)
{
  const System       system = Lattice{{7, 7, 7}}.assemble();
  const unsigned int before = ProcessSession::n_threads();
  ProcessSession::set_threads(1);
  const MatrixXd one =
    MumpsSchur(system.upper, 147, system.node_of).take_schur_complement();
  ProcessSession::set_threads(4);
  const MatrixXd four =
    MumpsSchur(system.upper, 147, system.node_of).take_schur_complement();
  ProcessSession::set_threads(before);
  EXPECT_LT((one - four).norm(), 1e-13 * one.norm());
}
