// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/partition.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
  using conetact::backends::partition;
  using conetact::backends::WeighedNode;

  /** Nodes of a grid, x fastest, of weight 1. */
  std::vector<WeighedNode>
  grid(const int nx, const int ny, const int nz)
  {
    std::vector<WeighedNode> nodes;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          nodes.push_back({{{1. * i, 1. * j, 1. * k}}, 1.});
    return nodes;
  }

  std::vector<double>
  weights(const std::vector<WeighedNode> &nodes,
          const std::vector<int>         &part,
          const int                       n)
  {
    std::vector<double> sums(static_cast<std::size_t>(n), 0.);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      sums[static_cast<std::size_t>(part[i])] += nodes[i].weight;
    return sums;
  }
} // namespace



TEST(Partition, HalvesTheLongestSide)
{
  const auto nodes = grid(4, 20, 5);
  const auto part  = partition(nodes, 2);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_EQ(part[i], nodes[i].position[1] < 10 ? 0 : 1);
}



TEST(Partition, SharesWorkNotNodes)
{
  auto nodes = grid(10, 9, 8);
  for (WeighedNode &node : nodes)
    node.weight = node.position[0] < 3 ? 4. : 1.;
  for (const int n : {1, 2, 3, 4, 7})
    {
      const std::vector<double> sums = weights(nodes, partition(nodes, n), n);
      const auto [least, most] = std::minmax_element(sums.begin(), sums.end());
      EXPECT_LE(*most - *least, 12.) << n << " parts";
    }
}



TEST(Partition, LeavesNoPartEmpty)
{
  auto nodes                     = grid(5, 1, 1);
  nodes[0].weight                = 1000.; // more than all others
  const std::vector<double> sums = weights(nodes, partition(nodes, 5), 5);
  EXPECT_GT(*std::min_element(sums.begin(), sums.end()), 0.);
  EXPECT_TRUE(partition({}, 3).empty());
}
