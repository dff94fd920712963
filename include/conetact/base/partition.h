// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_partition_h
#define conetact_base_partition_h

#include <algorithm>
#include <array>
#include <vector>

namespace conetact
{
  /** A node that has work, in numbers of any unit. */
  struct WeighedNode
  {
    std::array<double, 3> position;
    double                weight;
  };

  /**
   * The part of each node, of `n_parts` that have about the same work: nodes
   * are halved along the longest side of their box, and each half again
   * (Berger, Bokhari, IEEE Trans. Computers 36 (1987) 570-580). No part is
   * empty as long as there are as many nodes.
   */
  std::vector<int>
  partition(const std::vector<WeighedNode> &nodes, const int n_parts);

  /**
   * Numbers of nodes in the order of the lines of a regular mesh along the
   * axes, of which the longest come first: rows of a matrix make runs then
   * (RowRuns). Where most nodes have no line in common, all follow a curve that
   * fills space.
   */
  std::vector<int>
  order_of_lines(const std::vector<std::array<double, 3>> &positions);

  /** The process that has place i, where process p has first[p], ...,
   * first[p + 1] - 1. */
  inline int
  owner_of(const int i, const std::vector<int> &first)
  {
    return static_cast<int>(std::upper_bound(first.begin(), first.end(), i) -
                            first.begin() - 1);
  }
} // namespace conetact

#endif
