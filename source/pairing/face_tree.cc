// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/face_tree.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    using FaceBox = dealii::BoundingBox<3>;
    /** Balls that touch meet, whatever the rounding. */
    constexpr double slack = 1 + 1e-10;
    /** More than the root of 2: so far is a corner of the end of a tube from
     * its axis, over its radius. */
    constexpr double corner_of_tube = 1.415;

    FaceBox
    box_around(const Point<3> &a, const Point<3> &b, const double distance)
    {
      FaceBox box({a, a});
      box.merge_with(FaceBox({b, b}));
      box.extend(distance);
      return box;
    }
  } // namespace

  struct FaceTree::Boxes
  {
    dealii::RTree<std::pair<FaceBox, std::size_t>> tree;
  };

  FaceTree::FaceTree(const std::vector<Ball> &b)
    : balls(b)
  {
    std::vector<std::pair<FaceBox, std::size_t>> of_balls;
    for (const Ball &ball : balls)
      of_balls.emplace_back(box_around(ball.centre,
                                       ball.centre,
                                       corner_of_tube * ball.radius),
                            of_balls.size());
    // Boxes are larger than balls by the factor of corner_of_tube, which covers
    // the slack as well: no ball is missed, and meets() throws out what only
    // boxes touch.
    boxes = std::make_shared<const Boxes>(Boxes{dealii::pack_rtree(of_balls)});
  }

  template <class Meets>
  std::vector<std::size_t>
  FaceTree::find(const Point<3> &a,
                 const Point<3> &b,
                 const double    distance,
                 const Meets    &meets) const
  {
    namespace index = boost::geometry::index;
    std::vector<std::size_t> found;
    if (balls.empty())
      return found;
    for (const auto &[box, i] :
         boxes->tree | index::adaptors::queried(
                         index::intersects(box_around(a, b, distance))))
      if (meets(balls[i]))
        found.push_back(i);
    // Callers break ties by the first one: the order must not depend on the
    // tree.
    std::sort(found.begin(), found.end());
    return found;
  }

  std::vector<std::size_t>
  FaceTree::near(const Ball &ball) const
  {
    return find(ball.centre,
                ball.centre,
                slack * ball.radius,
                [&](const Ball &other) {
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
    return find(ball.centre - reach * unit_direction,
                ball.centre + reach * unit_direction,
                corner_of_tube * ball.radius,
                [&](const Ball &other) {
                  const Tensor<1, 3> arm     = other.centre - ball.centre;
                  const double       forward = arm * unit_direction;
                  const double meeting = slack * (ball.radius + other.radius);
                  return std::abs(forward) <= meeting + reach &&
                         (arm - forward * unit_direction).norm() <= meeting;
                });
  }
} // namespace conetact::pairing
