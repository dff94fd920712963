// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_closest_point_h
#define conetact_pairing_closest_point_h

#include "conetact/base/points.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace conetact::pairing
{
  /**
   * The point of a face, a segment, a triangle or a bilinear quadrilateral,
   * that is nearest to p. Corners are in deal.II's order.
   */
  struct ClosestPoint
  {
    std::array<double, 2> at{{0, 0}}; ///< in the unit square or triangle
    Point<3>              point;
    double                distance = 0; ///< from p [length]
  };
  ClosestPoint
  closest_point(const std::vector<Point<3>> &corners, const Point<3> &p);

  /**
   * The point of the face, continued beyond its edges, from which p lies along
   * a normal; none if the iteration from `near` finds none.
   */
  std::optional<std::array<double, 2>>
  point_along(const std::vector<Point<3>> &corners,
              const Point<3>              &p,
              const Tensor<1, 3>          &normal,
              const std::array<double, 2> &near);

  /** Linear or bilinear shape functions of the corners at a point, with zeros
   * behind them. */
  std::array<double, 4>
  shape_values(const std::size_t n_corners, const std::array<double, 2> &at);

  /** A unit normal there; which side it is on depends on the corners' order. */
  Tensor<1, 3>
  face_normal_at(const std::vector<Point<3>> &corners,
                 const std::array<double, 2> &at);

  /** Its length or area; a warped quadrilateral's is that of its mean plane. */
  double
  face_area(const std::vector<Point<3>> &corners);

  /** Calls with the two corners of each edge of a face; a segment is one. */
  void
  for_each_edge(
    const std::size_t                                                n_corners,
    const std::function<void(const std::size_t, const std::size_t)> &visit);

  /**
   * The vector of the cone that unit vectors span, @f$\sum \lambda_i n_i,\
   * \lambda_i \ge 0@f$, that is nearest to a direction of unit length; its
   * length is the cosine of the angle between them. Zero if the direction
   * points away from the cone.
   */
  Tensor<1, 3>
  nearest_in_cone(const Tensor<1, 3>              &direction,
                  const std::vector<Tensor<1, 3>> &cone);
} // namespace conetact::pairing

#endif
