// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/nodal_shapes.h"

#include <gtest/gtest.h>

#include <utility>

using namespace conetact::pairing;

namespace
{
  /** Nodes and corners of all kinds of faces. */
  const std::vector<std::pair<std::size_t, std::size_t>> kinds =
    {{2, 2}, {3, 3}, {4, 4}, {3, 2}, {9, 4}, {6, 3}};
} // namespace

TEST(NodalShapes, EachIsOneAtItsNodeOnly)
{
  const std::vector<std::array<double, 2>> nodes    = {{{0, 0}},
                                                       {{1, 0}},
                                                       {{0, 1}},
                                                       {{1, 1}},
                                                       {{0, .5}},
                                                       {{1, .5}},
                                                       {{.5, 0}},
                                                       {{.5, 1}},
                                                       {{.5, .5}}};
  const std::vector<std::array<double, 2>> of_edges = {{{.5, 0}},
                                                       {{.5, .5}},
                                                       {{0, .5}}};
  for (const auto &[n_nodes, n_corners] : kinds)
    for (std::size_t i = 0; i < n_nodes; ++i)
      {
        // behind the corners of a segment or triangle stand middles of edges
        const auto at =
          n_corners < 4 && i >= n_corners ? of_edges[i - n_corners] : nodes[i];
        const auto N = nodal_shape_values(n_nodes, n_corners, at);
        ASSERT_EQ(N.size(), n_nodes);
        for (std::size_t j = 0; j < n_nodes; ++j)
          EXPECT_EQ(N[j], i == j) << n_nodes << " nodes";
      }
}

TEST(NodalShapes, SumToOne)
{
  for (const auto &[n_nodes, n_corners] : kinds)
    {
      double sum = 0, shares = 0;
      for (const double N : nodal_shape_values(n_nodes, n_corners, {{.3, .2}}))
        sum += N;
      for (const double share : nodal_shares(n_nodes, n_corners))
        shares += share;
      EXPECT_NEAR(sum, 1, 1e-15);
      EXPECT_NEAR(shares, 1, 1e-15);
    }
}

TEST(NodalShapes, SharesAreIntegrals)
{
  // Simpson's rule in both directions is exact
  const std::array<double, 3> at      = {{0, .5, 1}},
                              weights = {{1. / 6, 4. / 6, 1. / 6}};
  for (const auto &[n_nodes, n_corners] : kinds)
    {
      if (n_corners == 3)
        continue;
      std::vector<double> sum(n_nodes, 0);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          {
            const auto N =
              nodal_shape_values(n_nodes, n_corners, {{at[i], at[j]}});
            for (std::size_t k = 0; k < n_nodes; ++k)
              sum[k] += weights[i] * weights[j] * N[k];
          }
      for (std::size_t k = 0; k < n_nodes; ++k)
        EXPECT_NEAR(sum[k], nodal_shares(n_nodes, n_corners)[k], 1e-15);
    }
}

TEST(NodalShapes, SlopesAreThoseOfDifferences)
{
  constexpr double small = 1e-6;
  for (const auto &[n_nodes, n_corners] : kinds)
    for (std::size_t d = 0; d < (n_corners == 2 ? 1 : 2); ++d)
      {
        std::array<double, 2> at = {{.3, .2}}, behind = at;
        behind[d] += small;
        const auto slopes = nodal_shape_slopes(n_nodes, n_corners, at)[d];
        const auto one    = nodal_shape_values(n_nodes, n_corners, at),
                   other  = nodal_shape_values(n_nodes, n_corners, behind);
        for (std::size_t i = 0; i < n_nodes; ++i)
          EXPECT_NEAR(slopes[i], (other[i] - one[i]) / small, 1e-5);
      }
}
