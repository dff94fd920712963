// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/body_way.h"

#include "conetact/bodies/placement.h"
#include "conetact/pairing/rigid_motion.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    /** Below this turn the chord of an arc stands for it [rad]: it is off by
     * the radius times turn^2 / 8, a part of 1e-7. */
    constexpr double no_turn = 1e-3;

    Tensor<1, 3>
    mean(const std::vector<Point<3>> &points)
    {
      Tensor<1, 3> sum;
      for (const Point<3> &p : points)
        sum += p;
      return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
    }

    Tensor<2, 3>
    rotation_by(const Tensor<1, 3> &axis, const double angle)
    {
      return angle > 0 ? bodies::rotation_about(axis, angle * 180 / M_PI) :
                         Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    }
  } // namespace

  BodyWay::BodyWay(std::vector<Point<3>>        from,
                   const std::vector<Point<3>> &to,
                   const Tensor<2, 3>          &rotation)
    : start(std::move(from))
  {
    if (const Tensor<1, 3> turn = rotation_vector(rotation);
        turn.norm() > no_turn)
      {
        angle = turn.norm();
        axis  = turn / angle;
      }
    const Tensor<2, 3> Q = rotation_by(axis, angle);
    const Tensor<1, 3> b = mean(to) - Q * mean(start);
    along                = angle > 0 ? (b * axis) * axis : b;
    if (angle > 0)
      {
        // The centre c solves (I - Q) c = b across the axis: c = (b + cot(angle
        // / 2) axis x b) / 2 (Chasles: a motion is a turn about an axis and a
        // way along it).
        const Tensor<1, 3> across = b - along;
        centre = Point<3>(.5 * (across + cross_product_3d(axis, across) /
                                           std::tan(.5 * angle)));
      }
    for (std::size_t i = 0; i < start.size(); ++i)
      strained.push_back(Tensor<1, 3>(to[i]) - Q * Tensor<1, 3>(start[i]) - b);
  }

  /** x(s) = c + Q(s angle) (X - c) + s (along + strained), which is exact at
   * both ends. */
  Point<3>
  BodyWay::at(const unsigned int node, const double part) const
  {
    Assert(part >= 0 && part <= 1,
           dealii::ExcMessage("A way has a start and an end."));
    const Point<3> straight = start[node] + part * (along + strained[node]);
    if (angle == 0)
      return straight;
    const Tensor<1, 3> arm = start[node] - centre;
    return straight + (rotation_by(axis, part * angle) * arm - arm);
  }
} // namespace conetact::pairing
