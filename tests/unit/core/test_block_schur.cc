// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/extended_schur.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lattice.h"

namespace
{
  using conetact::BlockSchurSolver;
  using conetact::ExtendedSchur;
  using conetact::Lattice;
  using conetact::SchurSolver;
  using conetact::SingularMatrix;
  using conetact::System;
  using Eigen::Index;
  using Eigen::MatrixXd;
  using SparseMatrix = Eigen::SparseMatrix<double>;

  // Bodies that are not coupled, their last `n_schur` unknowns behind all
  // others, as contact unknowns are.
  struct Assembly
  {
    System                    system;
    Index                     n_schur = 0;
    std::vector<unsigned int> body_of;

    Assembly(const std::vector<System> &bodies, const Index n_schur_each)
    {
      Index n = 0;
      for (const System &body : bodies)
        n += body.upper.cols();
      n_schur = n_schur_each * static_cast<Index>(bodies.size());
      body_of.resize(n);
      system.node_of.resize(n);
      std::vector<Eigen::Triplet<double>> entries;
      Index                               free = 0, last = n - n_schur;
      for (unsigned int k = 0; k < bodies.size(); ++k)
        {
          std::vector<Index> place(bodies[k].upper.cols());
          for (Index i = 0; i < bodies[k].upper.cols(); ++i)
            {
              place[i] =
                i < bodies[k].upper.cols() - n_schur_each ? free++ : last++;
              body_of[place[i]]        = k;
              system.node_of[place[i]] = 1000 * k + bodies[k].node_of[i];
            }
          for (Index column = 0; column < bodies[k].upper.cols(); ++column)
            for (SparseMatrix::InnerIterator entry(bodies[k].upper, column);
                 entry;
                 ++entry)
              entries.emplace_back(place[entry.row()],
                                   place[column],
                                   entry.value());
        }
      system.upper.resize(n, n);
      system.upper.setFromTriplets(entries.begin(), entries.end());
    }
  };

  double
  difference(const MatrixXd &a, const MatrixXd &b)
  {
    return b.size() == 0 ? 0. : (a - b).norm() / b.norm();
  }

  // Against one factor of all bodies.
  void
  check(const Assembly    &bodies,
        const unsigned int n_factors,
        const unsigned int n_shared)
  {
    const auto &[upper, node_of] = bodies.system;
    const Index      n = upper.cols(), n_schur = bodies.n_schur;
    BlockSchurSolver blocks(upper, n_schur, node_of, bodies.body_of);
    SchurSolver      whole(upper, n_schur, node_of);
    EXPECT_EQ(blocks.work().factorizations, n_factors);
    EXPECT_EQ(blocks.n_shared_bodies(), n_shared);
    EXPECT_LT(difference(blocks.take_schur_complement(),
                         whole.take_schur_complement()),
              1e-13);

    MatrixXd b = MatrixXd::Random(n, 70), u_C = MatrixXd::Random(n_schur, 70);
    b.col(1).setZero();
    b.col(2).head(n / 3).setZero();
    u_C.leftCols(2).setZero();
    EXPECT_LT(difference(blocks.reduce(b), whole.reduce(b)), 1e-13);
    EXPECT_LT(difference(blocks.expand(b, u_C), whole.expand(b, u_C)), 1e-13);
    EXPECT_EQ(blocks.expand(b, u_C).col(1).norm(), 0.);

    const auto estimate =
      BlockSchurSolver::estimate(upper, n_schur, node_of, bodies.body_of);
    EXPECT_GE(estimate.factor_bytes, .9 * blocks.factor_bytes());
    EXPECT_LE(estimate.factor_bytes, 1.5 * blocks.factor_bytes() + 1000);
  }

  const System one = Lattice{{5, 5, 4}}.assemble();

  System
  other()
  {
    Lattice lattice{{5, 5, 4}};
    lattice.contrast = 2.;
    return lattice.assemble();
  }
} // namespace



TEST(BlockSchur, FactorisesEqualBodiesOnce)
{
  for (const Index n_schur : {0, 1, 75})
    {
      check(Assembly({one, one}, n_schur), 1, 1);
      check(Assembly({one, one, one}, n_schur), 1, 2);
    }
}



TEST(BlockSchur, FactorisesOtherBodiesTogether)
{
  const System small = Lattice{{4, 5, 3}}.assemble();
  check(Assembly({one, other()}, 30), 1, 0);
  check(Assembly({one}, 30), 1, 0);
  check(Assembly({other(), one, one, small}, 30), 2, 1);
  check(Assembly({other(), one, other(), one}, 30), 2, 2);
}



TEST(BlockSchur, TellsRoundOffFromOtherValues)
{
  System moved = one;
  moved.upper.coeffs() *= 1. + 1e-14;
  check(Assembly({one, moved}, 30), 1, 1);
  moved.upper.coeffs() *= 1. + 1e-12;
  check(Assembly({one, moved}, 30), 1, 0);
}



TEST(BlockSchur, TakesTheOrderOfUnknownsAsItIs)
{
  // the same body, its unknowns in another order: not equal
  Eigen::PermutationMatrix<-1, -1> place(one.upper.cols());
  place.setIdentity();
  std::reverse(place.indices().data(), place.indices().data() + 40);
  System turned = one;
  turned.upper.selfadjointView<Eigen::Upper>() =
    one.upper.selfadjointView<Eigen::Upper>().twistedBy(place);
  check(Assembly({one, turned}, 30), 1, 0);
  check(Assembly({one, turned, turned}, 30), 2, 1);
}



TEST(BlockSchur, KeepsCoupledBodiesTogether)
{
  Assembly bodies({one, one, one}, 30);
  bodies.system.upper.coeffRef(10, 280) = 1e-3; // of the first two
  check(bodies, 1, 0);
  Assembly pairs({one, one, one, one}, 30);
  pairs.system.upper.coeffRef(10, 280)  = 1e-3;
  pairs.system.upper.coeffRef(550, 820) = 1e-3;
  pairs.system.upper.makeCompressed();
  check(pairs, 1, 2);
}



TEST(BlockSchur, IsExtended)
{
  const Assembly bodies({one, one}, 30);
  const auto &[upper, node_of] = bodies.system;
  ExtendedSchur blocks(upper, 60, node_of, bodies.body_of);
  ExtendedSchur whole(upper, 60, node_of);
  MatrixXd      S_blocks = blocks.base().take_schur_complement();
  MatrixXd      S_whole  = whole.base().take_schur_complement();
  blocks.extend({17, 400, 269}, S_blocks);
  whole.extend({17, 400, 269}, S_whole);
  EXPECT_LT(difference(S_blocks, S_whole), 1e-13);
  const MatrixXd b = MatrixXd::Random(upper.cols(), 3);
  EXPECT_LT(difference(blocks.reduce(b), whole.reduce(b)), 1e-13);
  // a unit force for each unknown, and a column of b for each body
  EXPECT_EQ(blocks.base().work().factorizations, 1u);
  EXPECT_EQ(blocks.base().work().reductions, 3u + 2 * 3u);
}



TEST(BlockSchur, NamesTheNodeThatMoves)
{
  Lattice lattice{{5, 5, 4}};
  lattice.support       = 0.;
  const System floating = lattice.assemble();
  for (const auto &list : {std::vector<System>{one, one, floating},
                           std::vector<System>{one, one, floating, floating}})
    try
      {
        const Assembly bodies(list, 0);
        BlockSchurSolver(bodies.system.upper,
                         0,
                         bodies.system.node_of,
                         bodies.body_of);
        FAIL();
      }
    catch (const SingularMatrix &error)
      {
        // no node where MUMPS itself meets a pivot below zero
        EXPECT_EQ(error.node.value_or(2000) / 1000, 2u);
      }
  Assembly empty({one, one}, 0);
  for (const Index column : {6, 306})
    empty.system.upper.coeffRef(column, column) = 0.;
  try
    {
      BlockSchurSolver(empty.system.upper,
                       0,
                       empty.system.node_of,
                       empty.body_of);
      FAIL();
    }
  catch (const SingularMatrix &error)
    {
      EXPECT_EQ(error.node.value_or(0), 2u);
    }
}
