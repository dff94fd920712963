// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/clipping.h"
#include "conetact/pairing/dual_functions.h"
#include "conetact/pairing/face_tree.h"
#include "conetact/pairing/projected_face.h"

// Boost would move points to a grid of 1e-7 of the box around them
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace conetact;
using namespace conetact::pairing;

namespace
{
  using BoostPoint   = boost::geometry::model::d2::point_xy<double>;
  using BoostPolygon = boost::geometry::model::polygon<BoostPoint, false>;

  BoostPolygon
  to_boost(const Polygon &polygon)
  {
    BoostPolygon result;
    for (const Point<2> &p : polygon)
      boost::geometry::append(result.outer(), BoostPoint(p[0], p[1]));
    boost::geometry::correct(result);
    return result;
  }

  /** Corners on a circle, so that it is convex. */
  Polygon
  random_polygon(std::mt19937 &random, const unsigned int n)
  {
    std::uniform_real_distribution<double> number(0, 1);
    std::vector<double>                    angles;
    for (unsigned int i = 0; i < n; ++i)
      angles.push_back(2 * M_PI * number(random));
    std::sort(angles.begin(), angles.end());
    const Point<2> centre(number(random), number(random));
    const double   radius = .1 + number(random);
    Polygon        result;
    for (const double a : angles)
      result.emplace_back(centre[0] + radius * std::cos(a),
                          centre[1] + radius * std::sin(a));
    return result;
  }

  double
  integral(const Polygon     &polygon,
           const int          a,
           const int          b,
           const unsigned int level)
  {
    double sum = 0;
    for (const PlanePoint &q : gauss_points(polygon, level))
      sum += q.weight * std::pow(q.position[0], a) * std::pow(q.position[1], b);
    return sum;
  }

  Polygon
  rectangle(const double x0, const double x1, const double y0, const double y1)
  {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  }
} // namespace



TEST(Clipping, CommonPartAndRestAsInBoost)
{
  std::mt19937 random(1);
  for (unsigned int trial = 0; trial < 2000; ++trial)
    {
      const Polygon a = random_polygon(random, 3 + trial % 2),
                    b = random_polygon(random, 3 + trial / 2 % 2);
      std::vector<BoostPolygon> both, rest;
      boost::geometry::intersection(to_boost(a), to_boost(b), both);
      boost::geometry::difference(to_boost(a), to_boost(b), rest);
      double area = 0, rest_area = 0, left = 0;
      for (const BoostPolygon &p : both)
        area += boost::geometry::area(p);
      for (const BoostPolygon &p : rest)
        rest_area += boost::geometry::area(p);
      const Polygon common = common_part(a, b);
      EXPECT_NEAR(measure(common), area, 1e-12);
      EXPECT_NEAR(measure(common), measure(common_part(b, a)), 1e-12);
      for (const Polygon &piece : without({a}, b))
        {
          left += measure(piece);
          EXPECT_NEAR(measure(common_part(piece, b)), 0, 1e-12);
        }
      EXPECT_NEAR(left, rest_area, 1e-12);
      if (area > 1e-12)
        {
          EXPECT_TRUE(boxes_overlap(a, b));
          EXPECT_TRUE(boost::geometry::within(
            BoostPoint(middle(common)[0], middle(common)[1]), to_boost(a)));
        }
    }
}



TEST(Clipping, SharedEdgesAndEqualPolygons)
{
  const Polygon a = rectangle(0, 1, 0, 1), b = rectangle(1, 2, 0, 1);
  EXPECT_EQ(measure(common_part(a, b)), 0);
  EXPECT_FALSE(boxes_overlap(a, b));
  EXPECT_EQ(measure(common_part(a, a)), 1);
  EXPECT_TRUE(without({a}, a).empty());
  EXPECT_EQ(without({a}, b).size(), 1u);
  const Polygon beside = {{1, 1}, {0, 1}, {.5, 3}};
  ASSERT_EQ(without({a}, beside).size(), 1u);
  EXPECT_EQ(measure(without({a}, beside)[0]), 1);
  EXPECT_EQ(measure(oriented({a.rbegin(), a.rend()})), 1);
}



TEST(Clipping, Intervals)
{
  const Polygon a = oriented({{2, 0}, {0, 0}}), b = {{1, 0}, {5, 0}};
  EXPECT_EQ(measure(a), 2);
  EXPECT_EQ(measure(common_part(a, b)), 1);
  EXPECT_EQ(without({b}, a).size(), 1u);
  EXPECT_EQ(measure(without({b}, a)[0]), 3);
  EXPECT_EQ(without({b}, Polygon({{2, 0}, {3, 0}})).size(), 2u);
  EXPECT_TRUE(common_part(a, {{2, 0}, {3, 0}}).empty());
  EXPECT_NEAR(integral(b, 5, 0, 0), (std::pow(5, 6) - 1) / 6, 1e-9);
}



TEST(Clipping, GaussPointsIntegratePolynomials)
{
  const Polygon p = rectangle(0, 2, 0, 1);
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; a + b <= 5; ++b)
      EXPECT_NEAR(integral(p, a, b, 0),
                  std::pow(2, a + 1) / (a + 1) / (b + 1),
                  1e-12);
  for (const unsigned int level : {1u, 2u, 3u})
    for (int a = 0; a <= 13; ++a)
      EXPECT_NEAR(integral(p, a, 13 - a, level) /
                    (std::pow(2, a + 1) / (a + 1) / (14 - a)),
                  1,
                  1e-12);
}



TEST(Clipping, ProjectedFaces)
{
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> number(-.2, .2);
  const ProjectionPlane                  plane(Point<3>(.1, .2, .3),
                              Tensor<1, 3>({.48, .6, .64}),
                              false);
  for (const unsigned int n : {3u, 4u})
    for (unsigned int trial = 0; trial < 50; ++trial)
      {
        std::vector<Point<3>> x;
        for (unsigned int i = 0; i < n; ++i)
          x.push_back(plane.origin +
                      (double(i % 2) + number(random)) * plane.axes[0] +
                      (double(i / 2) + number(random)) * plane.axes[1] +
                      number(random) * plane.normal);
        const ProjectedFace face(x, plane);
        EXPECT_GT(measure(face.outline()), 0);
        EXPECT_EQ(face.skewness() == 0, n == 3);
        const double a = .3, b = .4;
        const double N4[] = {(1 - a) * (1 - b),
                             a * (1 - b),
                             (1 - a) * b,
                             a * b};
        const double N3[] = {1 - a - b, a, b};
        Tensor<1, 3> p;
        for (unsigned int i = 0; i < n; ++i)
          p += (n == 4 ? N4[i] : N3[i]) * Tensor<1, 3>(x[i]);
        const auto seen = face.at(plane.project(Point<3>(p)));
        for (unsigned int i = 0; i < n; ++i)
          EXPECT_NEAR(seen.shape[i], n == 4 ? N4[i] : N3[i], 1e-12);
        EXPECT_NEAR(seen.height, plane.height(Point<3>(p)), 1e-12);
        if (n == 3)
          {
            EXPECT_NEAR(seen.stretch * measure(face.outline()),
                        .5 * cross_product_3d(x[1] - x[0], x[2] - x[0]).norm(),
                        1e-12);
          }
      }
}



TEST(DualFunctions, OfAWholeSegmentAndOfAPartOfIt)
{
  Eigen::Matrix2d mass;
  mass << 2, 1, 1, 2;
  Eigen::Matrix2d dual;
  dual << 2, -1, -1, 2;
  EXPECT_LT(
    (dual_functions(mass / 6, Eigen::Vector2d(.5, .5), {0, 1}) - dual).norm(),
    1e-14);
  // [0, c] of [0, 1]: 1 - x and x
  for (const double c : {.9, .5, .1, 1e-2, 1e-6})
    {
      Eigen::Matrix2d part;
      part(1, 1) = c * c * c / 3;
      part(0, 1) = part(1, 0) = c * c / 2 - part(1, 1);
      part(0, 0)              = c - 2 * part(0, 1) - part(1, 1);
      const Eigen::Vector2d areas(c - c * c / 2, c * c / 2);
      const Eigen::Matrix2d A = dual_functions(part, areas, {0, 1});
      EXPECT_LT((A * part - Eigen::Matrix2d(areas.asDiagonal())).norm(),
                1e-14 * c);
      EXPECT_LT((A.colwise().sum() - Eigen::RowVector2d::Ones()).norm(),
                1e-12 / c);
    }
}



TEST(DualFunctions, OfPartsTooSmallAreTheFunctionsThemselves)
{
  // a square of size c in the middle of the unit square
  for (const double c : {.9, .01})
    {
      Eigen::Matrix4d mass  = Eigen::Matrix4d::Zero();
      Eigen::Vector4d areas = Eigen::Vector4d::Zero();
      for (const PlanePoint &q : gauss_points(
             rectangle(.5 - c / 2, .5 + c / 2, .5 - c / 2, .5 + c / 2), 0))
        {
          const double          a = q.position[0], b = q.position[1];
          const Eigen::Vector4d N((1 - a) * (1 - b),
                                  a * (1 - b),
                                  (1 - a) * b,
                                  a * b);
          mass += q.weight * N * N.transpose();
          areas += q.weight * N;
        }
      const Eigen::Matrix4d A = dual_functions(mass, areas, {0, 1, 2, 3});
      EXPECT_LT((A * areas).sum() - c * c, 1e-12);
      if (c < .1)
        EXPECT_TRUE(A.isIdentity(0));
      else
        EXPECT_LT((A * mass - Eigen::Matrix4d(areas.asDiagonal())).norm(),
                  1e-14);
    }
}



TEST(FaceTree, FindsWhatALoopFinds)
{
  std::mt19937                           random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<FaceTree::Ball>            balls;
  const auto                             point = [&] {
    return Point<3>(number(random), number(random), number(random));
  };
  for (unsigned int i = 0; i < 500; ++i)
    balls.push_back({point(), .1 * std::abs(number(random))});
  const FaceTree tree(balls);
  for (unsigned int trial = 0; trial < 100; ++trial)
    {
      const FaceTree::Ball     ball{point(), .2};
      Tensor<1, 3>             along(point());
      std::vector<std::size_t> near, seen;
      along /= along.norm();
      for (std::size_t i = 0; i < balls.size(); ++i)
        {
          const Tensor<1, 3> arm     = balls[i].centre - ball.centre;
          const double       forward = arm * along;
          const double       meeting = ball.radius + balls[i].radius;
          if (arm.norm() <= meeting)
            near.push_back(i);
          if ((arm - forward * along).norm() <= meeting &&
              std::abs(forward) <= .5 + meeting)
            seen.push_back(i);
        }
      EXPECT_EQ(tree.near(ball), near);
      EXPECT_EQ(tree.along(ball, along, .5), seen);
    }
  EXPECT_TRUE(FaceTree().near({Point<3>(), 1}).empty());
}
