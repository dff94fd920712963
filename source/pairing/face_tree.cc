// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/face_tree.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace conetact::pairing
{
  namespace
  {
    constexpr std::size_t most_in_a_leaf = 4;
    /** Touching is meeting, whatever the rounding. */
    constexpr double slack = 1 + 1e-10;
  } // namespace

  FaceTree::FaceTree(const std::vector<Ball> &b)
    : balls(b)
    , order(b.size())
  {
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!balls.empty())
      grow(0, balls.size());
  }

  FaceTree::Ball
  FaceTree::around(const std::size_t begin, const std::size_t end) const
  {
    Assert(begin < end, dealii::ExcMessage("A branch has balls."));
    // Not the smallest ball, but one of about its size: centre of the box
    // around the centres.
    Point<3> low = balls[order[begin]].centre, high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        {
          low[d]  = std::min(low[d], balls[order[i]].centre[d]);
          high[d] = std::max(high[d], balls[order[i]].centre[d]);
        }
    Ball whole{low + .5 * (high - low), 0};
    for (std::size_t i = begin; i < end; ++i)
      whole.radius = std::max(whole.radius,
                              whole.centre.distance(balls[order[i]].centre) +
                                balls[order[i]].radius);
    return whole;
  }

  /** Halves along the longest side of the box around the centres. */
  std::size_t
  FaceTree::grow(const std::size_t begin, const std::size_t end)
  {
    Assert(begin < end, dealii::ExcMessage("A branch has balls."));
    const std::size_t self = branches.size();
    branches.push_back({around(begin, end), begin, end});
    if (end - begin <= most_in_a_leaf)
      return self;
    Tensor<1, 3> longest;
    for (std::size_t i = begin; i < end; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        longest[d] = std::max(longest[d],
                              std::abs(balls[order[i]].centre[d] -
                                       branches[self].ball.centre[d]));
    unsigned int axis = 0;
    for (unsigned int d = 1; d < 3; ++d)
      if (longest[d] > longest[axis])
        axis = d;
    // Halves of equal number: the depth is the logarithm of the number of faces
    // however these are spread.
    const std::size_t half = begin + (end - begin) / 2;
    const auto        at   = [&](const std::size_t i) {
      return order.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin),
                     at(half),
                     at(end),
                     [&](const std::size_t a, const std::size_t b) {
                       return balls[a].centre[axis] < balls[b].centre[axis];
                     });
    // The vector grows on the way: no reference to this branch would last.
    const std::size_t left = grow(begin, half), right = grow(half, end);
    branches[self].left  = left;
    branches[self].right = right;
    return self;
  }

  std::vector<std::size_t>
  FaceTree::find(const std::function<bool(const Ball &)> &may_meet) const
  {
    std::vector<std::size_t> found, waiting;
    if (!branches.empty())
      waiting.push_back(0);
    while (!waiting.empty())
      {
        const Branch &branch = branches[waiting.back()];
        waiting.pop_back();
        if (!may_meet(branch.ball))
          continue;
        if (branch.left > 0)
          waiting.insert(waiting.end(), {branch.left, branch.right});
        else
          for (std::size_t i = branch.begin; i < branch.end; ++i)
            if (may_meet(balls[order[i]]))
              found.push_back(order[i]);
      }
    // Callers break ties by the first one: the order must not depend on the
    // tree.
    std::sort(found.begin(), found.end());
    return found;
  }

  std::vector<std::size_t>
  FaceTree::near(const Ball &ball) const
  {
    return find([&](const Ball &other) {
      return ball.centre.distance(other.centre) <=
             slack * (ball.radius + other.radius);
    });
  }

  std::vector<std::size_t>
  FaceTree::along(const Ball         &ball,
                  const Tensor<1, 3> &unit_direction,
                  const double        reach) const
  {
    Assert(std::abs(unit_direction.norm() - 1) < 1e-6,
           dealii::ExcMessage("Directions have unit length."));
    return find([&](const Ball &other) {
      const Tensor<1, 3> arm     = other.centre - ball.centre;
      const double       forward = arm * unit_direction;
      const double       meeting = slack * (ball.radius + other.radius);
      return std::abs(forward) <= meeting + reach &&
             (arm - forward * unit_direction).norm() <= meeting;
    });
  }
} // namespace conetact::pairing
