// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
  using conetact::order_of_lines;
  using conetact::partition;
  using conetact::WeighedNode;

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



TEST(Partition, CutsBetweenPlanesIfTheyAreNear)
{
  const auto in_first = [](const int n_planes) {
    const auto part = partition(grid(4, n_planes, 5), 2);
    return std::count(part.begin(), part.end(), 0);
  };
  EXPECT_EQ(in_first(65) % 20, 0); // a plane more or less hardly matters
  EXPECT_EQ(in_first(5), 50);
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



TEST(Partition, OrdersNodesByLines)
{
  // along y, the longest side; coordinates as rounding leaves them
  const auto                         nodes = grid(4, 20, 7);
  std::vector<std::array<double, 3>> shuffled;
  for (const WeighedNode &node : nodes)
    {
      shuffled.push_back(node.position);
      for (double &x : shuffled.back())
        x = (x / 3. + .1) * 3. - .3;
    }
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  const std::vector<int> order = order_of_lines(shuffled);
  const auto             at    = [&](const std::size_t i) {
    return shuffled[static_cast<std::size_t>(order[i])];
  };
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_NEAR(at(i)[1], static_cast<double>(i % 20), 1e-9);
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (i % 20 > 0)
      {
        EXPECT_NEAR(at(i)[0], at(i - 1)[0], 1e-9);
        EXPECT_NEAR(at(i)[2], at(i - 1)[2], 1e-9);
      }
}



/* Neighbours along the curve are much nearer than any two nodes, .66. */
TEST(Partition, NodesWithoutLinesFollowACurve)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> number(0., 1.);
  std::vector<std::array<double, 3>>     positions;
  for (int i = 0; i < 1000; ++i)
    positions.push_back({{number(random), number(random), number(random)}});
  std::vector<int> order = order_of_lines(positions);
  double           way   = 0;
  for (std::size_t k = 1; k < order.size(); ++k)
    {
      const auto &a = positions[static_cast<std::size_t>(order[k])];
      const auto &b = positions[static_cast<std::size_t>(order[k - 1])];
      way += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
  EXPECT_LT(way, .15 * static_cast<double>(order.size()));
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k)
    EXPECT_EQ(order[k], static_cast<int>(k)) << "each once";
  EXPECT_EQ(order_of_lines({{{1., 2., 3.}}, {{1., 2., 3.}}}).size(), 2u);
  EXPECT_TRUE(order_of_lines({}).empty());
}
