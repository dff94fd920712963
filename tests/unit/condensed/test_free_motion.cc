// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/condenser.h"

#include <gtest/gtest.h>

#include "lattice.h"

namespace
{
  using conetact::Lattice;
  using conetact::System;
  using conetact::condensed::Condenser;
  using conetact::condensed::condenser_table;
  using conetact::condensed::SingularMatrix;
  using Eigen::Index;

  void
  expect_singular(const System &system, const Index n_schur)
  {
    for (const Condenser &condenser : condenser_table())
      EXPECT_THROW(condenser.create(system.upper, n_schur, system.node_of),
                   SingularMatrix)
        << condenser.name;
  }

  void
  expect_regular(const System &system, const Index n_schur)
  {
    for (const Condenser &condenser : condenser_table())
      EXPECT_NO_THROW(condenser.create(system.upper, n_schur, system.node_of))
        << condenser.name;
  }
} // namespace



TEST(FreeMotion, RefusesBodiesThatCanMove)
{
  for (const double stiffness : {1e-9, 1., 1e12})
    {
      Lattice floating{{6, 5}};
      floating.stiffness = stiffness;
      floating.support   = 0.;
      expect_singular(floating.assemble(), 0);
      floating.shear = 0.; // now it can turn about the held corner
      expect_singular(floating.assemble(), 2);
      expect_regular(floating.assemble(), 4);

      Lattice block{{7, 6, 8}};
      block.stiffness = stiffness;
      block.support   = 0.;
      block.shear     = 0.;
      for (const Index held : {0, 1, 2, 3, 6})
        expect_singular(block.assemble(), held);
      expect_regular(block.assemble(), 3 * 7 * 6);
    }
}



TEST(FreeMotion, AcceptsSlenderAndContrastingBodies)
{
  for (const double stiffness : {1e-9, 1., 1e12})
    {
      Lattice beam{{3, 200}};
      beam.stiffness = stiffness;
      beam.shear     = 0.;
      expect_regular(beam.assemble(), 0);
      beam.contrast = 1e6;
      expect_regular(beam.assemble(), 0);
      beam.contrast = 1e-6;
      expect_regular(beam.assemble(), 0);
    }
}



TEST(FreeMotion, RefusesAnEmptyRowAndANegativeDiagonal)
{
  System system               = Lattice{{4, 4}}.assemble();
  system.upper.coeffRef(3, 3) = -1.;
  expect_singular(system, 8);
  System empty;
  empty.upper.resize(3, 3);
  empty.upper.insert(0, 0) = 1.;
  empty.upper.insert(2, 2) = 1.;
  empty.node_of            = {0, 1, 2};
  expect_singular(empty, 1);
  System indefinite;
  indefinite.upper.resize(3, 3);
  indefinite.upper.setIdentity();
  indefinite.upper.insert(0, 1) = 2.;
  indefinite.node_of            = {0, 1, 2};
  // no stiffness is like that, and LU does not see it
  EXPECT_THROW(conetact::condensed::default_condenser().create(indefinite.upper,
                                                               1,
                                                               {0, 1, 2}),
               SingularMatrix);
}



TEST(FreeMotion, IsNamedByANodeOfThePartThatMoves)
{
  // Two bodies: the first is held, the second, nodes 100 and up, floats.
  Lattice lattice{{5, 4}};
  System  system                               = lattice.assemble();
  lattice.support                              = 0.;
  lattice.shear                                = 0.;
  const System                        floating = lattice.assemble();
  const Index                         n        = system.upper.cols();
  std::vector<Eigen::Triplet<double>> entries;
  for (Index shift : {Index(0), n})
    for (Index column = 0; column < n; ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(
             shift == 0 ? system.upper : floating.upper, column);
           entry;
           ++entry)
        entries.emplace_back(entry.row() + shift,
                             column + shift,
                             entry.value());
  for (Index i = 0; i < n; ++i)
    system.node_of.push_back(100 +
                             floating.node_of[static_cast<std::size_t>(i)]);
  system.upper.resize(2 * n, 2 * n);
  system.upper.setFromTriplets(entries.begin(), entries.end());
  for (const Condenser &condenser : condenser_table())
    try
      {
        condenser.create(system.upper, 2, system.node_of); // one node of it
        ADD_FAILURE() << condenser.name;
      }
    catch (const SingularMatrix &error)
      {
        // no node where MUMPS itself meets a pivot below zero
        EXPECT_GE(error.node.value_or(100), 100u) << condenser.name;
      }
}
