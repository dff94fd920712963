// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <gtest/gtest.h>

#include <cmath>

#include "obstacle_fixture.h"

using namespace conetact;
using namespace conetact::pairing;

namespace
{
  void
  expect_near(const Tensor<1, 3> &a, const Tensor<1, 3> &b, const double tol)
  {
    EXPECT_LE((a - b).norm(), tol) << a << " is not " << b;
  }

  /**
   * Where the surface is smooth around p the gap is a distance: it changes by
   * the normal, and the foot lies on the surface.
   */
  void
  expect_distance(const Obstacle    &obstacle,
                  const Point<3>    &p,
                  const unsigned int dim)
  {
    const double h  = 1e-6;
    const auto   at = obstacle.shape->closest(p, 1);
    EXPECT_NEAR(at.normal.norm(), 1, 1e-14);
    for (unsigned int d = 0; d < dim; ++d)
      {
        Tensor<1, 3> step;
        step[d] = h;
        EXPECT_NEAR((obstacle.shape->closest(p + step, 1).gap -
                     obstacle.shape->closest(p - step, 1).gap) /
                      (2 * h),
                    at.normal[d],
                    1e-8)
          << "at " << p;
      }
    EXPECT_NEAR(obstacle.shape->closest(p - at.gap * at.normal, 1).gap,
                0,
                1e-14);
  }

  const std::string cone =
    "Shape = cone | Point = 0, 0, 1 | Axis = 0, 0, 2 | Half angle = 30";
} // namespace

TEST(ObstacleShapes, Cone)
{
  const Obstacle sharp = make_obstacle(cone, 3);
  for (const Point<3> &p : {Point<3>(2, 1, 2),
                            Point<3>(.1, -.2, 3),
                            Point<3>(.3, .1, -1),
                            Point<3>(1, 0, .9)})
    expect_distance(sharp, p, 3);
  // the side at half the angle: a point straight out of it
  const double s = std::sin(M_PI / 6), c = std::cos(M_PI / 6);
  const auto   at =
    sharp.shape->closest({4 * s + .5 * c, 0, 1 + 4 * c - .5 * s}, 1);
  EXPECT_NEAR(at.gap, .5, 1e-14);
  expect_near(at.normal, Tensor<1, 3>({c, 0, -s}), 1e-14);
}

TEST(ObstacleShapes, ApexOfACone)
{
  const Obstacle sharp = make_obstacle(cone, 3);
  // at the apex, and where every line of the side is as near: along the axis
  const auto on = sharp.shape->closest({0, 0, 1}, 1);
  EXPECT_EQ(on.gap, 0);
  expect_near(on.normal, Tensor<1, 3>({0, 0, -1}), 0);
  const auto in = sharp.shape->closest({0, 0, 1.5}, 1);
  EXPECT_EQ(in.gap, -.5);
  expect_near(in.normal, Tensor<1, 3>({0, 0, -1}), 0);
  const auto above = sharp.shape->closest({.3, 0, .6}, 1);
  EXPECT_NEAR(above.gap, .5, 1e-15);
  expect_near(above.normal, Tensor<1, 3>({.6, 0, -.8}), 1e-15);

  const Obstacle round = make_obstacle(cone + " | Apex radius = .1", 3);
  EXPECT_NEAR(round.shape->closest({0, 0, 1}, 1).gap, .1 / .5 - .1, 1e-15);
  for (const Point<3> &p : {Point<3>(0, 0, 1.05),
                            Point<3>(.01, .02, 1.1),
                            Point<3>(.1, 0, 1.13),
                            Point<3>(.2, .1, 1.5)})
    expect_distance(round, p, 3);
  const auto middle = round.shape->closest({0, 0, 1.2}, 1);
  EXPECT_NEAR(middle.gap, -.1, 1e-15);
  expect_near(middle.normal, Tensor<1, 3>({0, 0, -1}), 0);
}

TEST(ObstacleShapes, WedgeInThePlane)
{
  const Obstacle wedge = make_obstacle(
    "Shape = cone | Point = 1, 2 | Axis = 0, -1 | Half angle = 60");
  expect_distance(wedge, {1.5, 1, 0}, 2);
  expect_distance(wedge, {.5, 3, 0}, 2);
  const auto beside = wedge.shape->closest({3, 2, 0}, 1);
  EXPECT_NEAR(beside.gap, 2 * .5, 1e-15);
}

TEST(ObstacleShapes, Box)
{
  const Obstacle box =
    make_obstacle("Shape = box | Center = 1, 2, 3 | Sizes = 2, 4, 6", 3);
  for (const Point<3> &p : {Point<3>(3, 2, 3),
                            Point<3>(3, 5, 3.5),
                            Point<3>(-1, -1, -1),
                            Point<3>(1.1, 2.2, 5.7)})
    expect_distance(box, p, 3);
  // the corner (2, 4, 6), an edge, the centre
  const auto corner = box.shape->closest({3, 6, 8}, 1);
  EXPECT_NEAR(corner.gap, 3, 1e-15);
  expect_near(corner.normal, Tensor<1, 3>({1, 2, 2}) / 3., 1e-15);
  const auto edge = box.shape->closest({2, 4, 3}, 1);
  EXPECT_EQ(edge.gap, 0);
  expect_near(edge.normal, Tensor<1, 3>({1, 1, 0}) / std::sqrt(2.), 1e-15);
  const auto centre = box.shape->closest({1, 2, 3}, 1);
  EXPECT_EQ(centre.gap, -1);
  expect_near(centre.normal, Tensor<1, 3>({1, 0, 0}), 0);
  expect_near(box.shape->closest({2, 2.5, 3}, 1).normal,
              Tensor<1, 3>({1, 0, 0}),
              0);
}

TEST(ObstacleShapes, BoxThatIsTurned)
{
  const Obstacle box =
    make_obstacle("Shape = box | Sizes = 2, 4 | Rotation = 90");
  EXPECT_EQ(box.shape->closest({3, .5, 0}, 1).gap, 1);
  expect_near(box.shape->closest({3, .5, 0}, 1).normal,
              Tensor<1, 3>({1, 0, 0}),
              0);
  expect_distance(
    make_obstacle("Shape = box | Sizes = 2, 4, 1 | Rotation = 1, 1, 0, 30", 3),
    {2, 3, 1},
    3);
}
