// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/elimination_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lattice.h"

namespace
{
  using conetact::Lattice;
  using conetact::System;
  using Eigen::Index;
} // namespace



TEST(EliminationOrder, IsAPermutationWithNodesInOnePiece)
{
  const System           system = Lattice{{6, 5, 4}}.assemble();
  const Index            f      = system.upper.cols() - 40;
  const std::vector<int> places =
    conetact::condensed::elimination_order(system.upper, f, system.node_of);
  std::vector<int> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    EXPECT_EQ(sorted[i], static_cast<int>(i));
  for (std::size_t i = static_cast<std::size_t>(f); i < places.size(); ++i)
    EXPECT_EQ(places[i], static_cast<int>(i));
  for (std::size_t i = 1; i < static_cast<std::size_t>(f); ++i)
    if (system.node_of[i] == system.node_of[i - 1])
      {
        EXPECT_EQ(places[i], places[i - 1] + 1);
      }
}
