// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/master_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "faces_only.h"

using namespace conetact;
using namespace conetact::pairing;
using test::FacesOnly;

namespace
{
  using Normals = std::vector<Tensor<1, 3>>;

  const MasterSurface::Limits limits = {10, .5, .05, true};

  Tensor<1, 3>
  vec(const double x, const double y, const double z = 0)
  {
    return Tensor<1, 3>({x, y, z});
  }

  void
  expect_foot(const MasterSurface &master,
              const Point<3>      &p,
              const Normals       &slave,
              const double         gap,
              Tensor<1, 3>         normal)
  {
    const auto foot = master.foot(p, slave, limits);
    ASSERT_TRUE(foot) << p;
    normal /= normal.norm();
    EXPECT_NEAR(foot->gap, gap, 1e-12) << p;
    EXPECT_LT((foot->normal - normal).norm(), 1e-12) << p << foot->normal;
    double sum = 0;
    for (const auto &[node, weight] : foot->masters)
      sum += weight;
    EXPECT_NEAR(sum, 1, 1e-14);
  }

  void
  expect_free(const MasterSurface &master,
              const Point<3>      &p,
              const Normals       &slave)
  {
    const auto foot = master.foot(p, slave, limits);
    EXPECT_FALSE(foot) << p << " meets " << foot->gap << ", " << foot->normal;
  }

  /**
   * `n` faces around an apex at height `h` over a ring of radius 1, or
   * without the last `missing` ones.
   */
  FacesOnly
  roof(const unsigned int n, const double h, const unsigned int missing = 0)
  {
    std::vector<Point<3>> points = {{0, 0, h}};
    for (unsigned int i = 0; i < 2 * n; ++i)
      {
        // sides of a polygon: the outer node of each face is at its corner
        const double angle = M_PI * i / n;
        const double r     = i % 2 == 0 ? std::cos(M_PI / n) : 1;
        points.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
      }
    std::vector<FacesOnly::Face> faces;
    for (unsigned int i = 0; i < n - missing; ++i)
      faces.push_back(
        {{0, 1 + 2 * i, 1 + (2 * i + 2) % (2 * n), 2 + 2 * i}, 0});
    return FacesOnly(std::move(points), std::move(faces), false);
  }
} // namespace



TEST(PairingClosestPoint, IsTheNearestOfAllPointsOfAWarpedFace)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned int trial = 0; trial < 300; ++trial)
    {
      std::vector<Point<3>> corners;
      for (unsigned int i = 0; i < 4; ++i)
        corners.emplace_back(i % 2 + .3 * uniform(random),
                             i / 2 + .3 * uniform(random),
                             .3 * uniform(random));
      const Point<3> p(.5 + 1.5 * uniform(random),
                       .5 + 1.5 * uniform(random),
                       .5 * uniform(random));
      const auto     found = closest_point(corners, p);
      double         least = 1e10;
      for (unsigned int i = 0; i <= 100; ++i)
        for (unsigned int j = 0; j <= 100; ++j)
          {
            const auto   w = shape_values(4, {{i / 100., j / 100.}});
            Tensor<1, 3> x;
            for (unsigned int c = 0; c < 4; ++c)
              x += w[c] * Tensor<1, 3>(corners[c]);
            least = std::min(least, (Tensor<1, 3>(p) - x).norm());
          }
      EXPECT_LE(found.distance, least + 1e-12) << trial;
      EXPECT_GE(found.distance, least - .02) << trial;
    }
}



TEST(PairingClosestPoint, OfASegmentAndAFlatFaceIsExact)
{
  const auto on = closest_point({{0, 0, 0}, {2, 0, 0}}, {.5, 3, 0});
  EXPECT_DOUBLE_EQ(on.at[0], .25);
  EXPECT_DOUBLE_EQ(on.distance, 3);
  const std::vector<Point<3>> trapeze = {{0, 0, 0},
                                         {4, 0, 0},
                                         {1, 2, 0},
                                         {2, 2, 0}};
  EXPECT_NEAR(closest_point(trapeze, {1.4, 1.3, -7}).distance, 7, 1e-14);
  EXPECT_NEAR(closest_point(trapeze, {-3, 0, 4}).distance, 5, 1e-14);
}



TEST(PairingClosestPoint, NearestVectorOfACone)
{
  const Normals cone    = {vec(1, 0), vec(0, 1)};
  const auto    nearest = [&](const Tensor<1, 3> &v) {
    return nearest_in_cone(v, cone);
  };
  EXPECT_LT((nearest(vec(.6, .8)) - vec(.6, .8)).norm(), 1e-15);
  EXPECT_LT((nearest(vec(.6, -.8)) - vec(.6, 0)).norm(), 1e-15);
  EXPECT_LT((nearest(vec(.6, 0, .8)) - vec(.6, 0)).norm(), 1e-15);
  EXPECT_EQ(nearest(vec(-.6, -.8)).norm(), 0);

  // against one coefficient after the other
  std::mt19937                           random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned int trial = 0; trial < 200; ++trial)
    {
      Normals      normals;
      Tensor<1, 3> v;
      for (unsigned int i = 0; i <= trial % 7; ++i)
        {
          v = vec(uniform(random), uniform(random), uniform(random));
          normals.push_back(v / v.norm());
        }
      v = vec(uniform(random), uniform(random), uniform(random));
      v /= v.norm();
      std::vector<double> lambda(normals.size(), 0.);
      Tensor<1, 3>        rest = v;
      for (unsigned int sweep = 0; sweep < 5000; ++sweep)
        for (std::size_t i = 0; i < normals.size(); ++i)
          {
            const double next = std::max(lambda[i] + rest * normals[i], 0.);
            rest -= (next - lambda[i]) * normals[i];
            lambda[i] = next;
          }
      EXPECT_LT((nearest_in_cone(v, normals) - (v - rest)).norm(), 1e-6)
        << trial;
    }
}



TEST(PairingFoot, InsideAFaceAndThroughIt)
{
  const FacesOnly     body = test::cube(2);
  const MasterSurface master(body, {0, 1, 2, 3, 4, 5});
  expect_foot(master, {.3, .3, 1.2}, {vec(0, 0, -1)}, .2, vec(0, 0, 1));
  expect_foot(master, {.3, .3, .95}, {vec(0, 0, -1)}, -.05, vec(0, 0, 1));
  expect_foot(master, {.3, .3, .7}, {vec(0, 0, -1)}, -.3, vec(0, 0, 1));
  const FacesOnly     plane = test::square();
  const MasterSurface top(plane, {0, 1, 2, 3});
  expect_foot(top, {.3, 1.2, 0}, {vec(0, -1)}, .2, vec(0, 1));
  expect_foot(top, {.3, .9, 0}, {vec(0, -1)}, -.1, vec(0, 1));
}



TEST(PairingFoot, OfNormalsThatDoNotOpposeIsNone)
{
  const FacesOnly     body = test::cube(3);
  const MasterSurface all(body, {0, 1, 2, 3, 4, 5});
  // above the body and looking away: the bottom looks against it, but is
  // hidden, and the node is not inside
  expect_free(all, {.3, .3, 2}, {vec(0, 0, 1)});
  expect_free(all, {.3, .3, 1.1}, {vec(1, 0, 0)});
  const MasterSurface bottom(body, {4});
  expect_free(bottom, {.3, .3, 2}, {vec(0, 0, 1)});
  expect_free(bottom, {.3, .3, 1.1}, {vec(0, 0, 1)});
  expect_foot(bottom, {.3, .3, .1}, {vec(0, 0, 1)}, -.1, vec(0, 0, -1));
  // 59 and 61 degrees
  const double        c = std::cos(M_PI / 3 - .02), s = std::sqrt(1 - c * c);
  const double        d = std::cos(M_PI / 3 + .02), t = std::sqrt(1 - d * d);
  const MasterSurface top(body, {5});
  expect_foot(top, {.3, .3, 1.1}, {vec(s, 0, -c)}, .1, vec(0, 0, 1));
  expect_free(top, {.3, .3, 1.1}, {vec(t, 0, -d)});
  // one of the faces at the node is enough
  expect_foot(
    top, {.3, .3, 1.1}, {vec(1, 0, 0), vec(0, 0, -1)}, .1, vec(0, 0, 1));
  const FacesOnly     plane = test::square();
  const MasterSurface ring(plane, {0, 1, 2, 3});
  expect_free(ring, {.5, 2, 0}, {vec(0, 1)});
  expect_free(ring, {.5, 1.1, 0}, {vec(1, 0)});
}



TEST(PairingFoot, ForcesBeyondARimHaveNoMoment)
{
  const FacesOnly     body = test::cube(2);
  const MasterSurface top(body, {5});
  for (const double beyond : {0., .001, .004})
    {
      const Point<3> p(1 + beyond, .3, 1.01);
      const auto     foot = top.foot(p, {vec(0, 0, -1)}, limits);
      ASSERT_TRUE(foot);
      Tensor<1, 3> acting;
      for (const auto &[node, weight] : foot->masters)
        acting += weight * Tensor<1, 3>(body.position(node));
      EXPECT_LT((acting - vec(p[0], p[1], 1)).norm(), 1e-14);
    }
}



TEST(PairingFoot, BesideTheRimIsNone)
{
  const FacesOnly     body = test::cube(2);
  const MasterSurface top(body, {5});
  const Normals       down = {vec(0, 0, -1)};
  for (const double z : {1., 1.0001, 1.1, 2., .96})
    {
      expect_free(top, {1.02, .3, z}, down);
      expect_free(top, {-.02, .3, z}, down);
      expect_free(top, {1.02, 1.02, z}, down);
      // a hundredth of the face of 0.5 is round-off of meshes
      expect_foot(top, {1.004, .3, z}, down, z - 1, vec(0, 0, 1));
      expect_foot(top, {1.003, -.003, z}, down, z - 1, vec(0, 0, 1));
      expect_foot(top, {1, 0, z}, down, z - 1, vec(0, 0, 1));
    }
  const FacesOnly     plane = test::square();
  const MasterSurface edge(plane, {3});
  expect_free(edge, {1.02, 1, 0}, {vec(0, -1)});
  expect_free(edge, {-.3, 1.5, 0}, {vec(0, -1)});
  expect_foot(edge, {1.004, 1.5, 0}, {vec(0, -1)}, .5, vec(0, 1));
}



TEST(PairingFoot, FlatSlavesDoNotMeetEdgesBesideThem)
{
  // the same with the sides of the body in the surface: no sideways normals
  const FacesOnly     body = test::cube(2);
  const MasterSurface all(body, {0, 1, 2, 3, 4, 5});
  const Normals       down = {vec(0, 0, -1)};
  for (const double x : {1.02, 1.1, 1.5})
    for (const double z : {1., 1.0001, 1.02})
      {
        expect_free(all, {x, .3, z}, down);
        expect_free(all, {x, x, z}, down);
      }
  expect_foot(all, {1.004, .3, 1.1}, down, .1, vec(0, 0, 1));
  expect_foot(all, {1.004, .3, 1}, down, 0, vec(0, 0, 1));
  expect_foot(all, {1, 1, 1}, down, 0, vec(0, 0, 1));
  // the edge of a slave meets it
  expect_foot(all,
              {1.3, .3, 1.3},
              {vec(0, 0, -1), vec(-1, 0, 0)},
              .3 * std::sqrt(2),
              vec(1, 0, 1));
}



TEST(PairingFoot, OnRidgesAndVerticesLooksAtTheNode)
{
  const FacesOnly     body = test::cube(1);
  const MasterSurface all(body, {0, 1, 2, 3, 4, 5});
  for (const double d : {.01, .1, 1.})
    {
      Tensor<1, 3> n = vec(1, 0, 1) / std::sqrt(2);
      expect_foot(all, Point<3>(1, .4, 1) + d * n, {-n}, d, n);
      n = vec(1, 1, 1) / std::sqrt(3);
      expect_foot(all, Point<3>(1, 1, 1) + d * n, {-n}, d, n);
    }
  const FacesOnly     plane = test::square();
  const MasterSurface ring(plane, {0, 1, 2, 3});
  const Tensor<1, 3>  n = vec(.6, .8);
  expect_foot(ring, Point<3>(1, 1, 0) + .3 * n, {-n}, .3, n);
}



TEST(PairingFoot, VerticesOfAnyValenceAreInside)
{
  for (const unsigned int n : {3u, 4u, 5u, 6u})
    for (const double h : {.2, .6})
      {
        const FacesOnly     body = roof(n, h);
        const MasterSurface whole(body, {0});
        const Normals       down = {vec(0, 0, -1)};
        for (const double gap : {1e-3, .1, .5})
          expect_foot(whole, {0, 0, h + gap}, down, gap, vec(0, 0, 1));
        expect_foot(whole, {0, 0, h}, down, 0, vec(0, 0, 1));
        // two faces missing: the apex lies on the rim, and p beside them
        const FacesOnly     part = roof(n, h, 2);
        const MasterSurface open(part, {0});
        const double        angle = 2 * M_PI * (n - 1) / n;
        for (const double gap : {.1, .5})
          expect_free(open,
                      {.4 * std::cos(angle), .4 * std::sin(angle), h + gap},
                      down);
      }
}



TEST(PairingFoot, InAFunnelIsOnItsFaces)
{
  for (const unsigned int n : {3u, 4u, 5u, 6u})
    {
      const FacesOnly     body = roof(n, -.3);
      const MasterSurface funnel(body, {0});
      const Point<3>      p(.01, .02, .2);
      const auto          foot = funnel.foot(p, {vec(0, 0, -1)}, limits);
      ASSERT_TRUE(foot);
      double least = 1e10;
      for (const auto &face : body.surface({0}).faces)
        {
          std::vector<Point<3>> corners;
          for (const unsigned int node : face.nodes)
            corners.push_back(body.position(node));
          least = std::min(least, closest_point(corners, p).distance);
        }
      EXPECT_NEAR(foot->gap, least, 1e-12);
      EXPECT_GT(foot->normal[2], .85);
    }
}



TEST(PairingFoot, AboveTheEndOfARidgeThatIsCutOff)
{
  // two slopes of 45 degrees, cut at y = 0 and y = 1
  const FacesOnly body(
    {{-1, 0, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 0}, {1, 1, 0}},
    {{{2, 3, 0, 1}, 0}, {{4, 5, 2, 3}, 0}},
    false);
  const MasterSurface master(body, {0});
  for (const double y : {0., .3, 1.})
    expect_foot(master, {0, y, 1.2}, {vec(0, 0, -1)}, .2, vec(0, 0, 1));
  expect_free(master, {0, 1.1, 1.2}, {vec(0, 0, -1)});
}



TEST(PairingFoot, FacesWithHangingNodesLeaveNoHoles)
{
  // one face beside two halves of another
  FacesOnly body({{0, 0, 0},
                  {1, 0, 0},
                  {0, 1, 0},
                  {1, 1, 0},
                  {1, .5, 0},
                  {2, 0, 0},
                  {2, .5, 0},
                  {2, 1, 0}},
                 {{{0, 1, 2, 3}, 0}, {{1, 5, 4, 6}, 0}, {{4, 6, 3, 7}, 0}},
                 false);
  body.hanging = {{4, {{1, .5}, {3, .5}}}};
  const MasterSurface master(body, {0});
  for (const double x : {.99, 1., 1.01})
    for (const double y : {0., .2, .5, .7, 1.})
      for (const double gap : {0., 1e-9, .3})
        expect_foot(master, {x, y, gap}, {vec(0, 0, -1)}, gap, vec(0, 0, 1));
  // curved there: the cracks belong to the surface
  FacesOnly bent({{0, 0, -.2},
                  {1, 0, 0},
                  {0, 1, -.2},
                  {1, 1, 0},
                  {1, .5, 0},
                  {2, 0, -.2},
                  {2, .5, -.2},
                  {2, 1, -.2}},
                 {{{0, 1, 2, 3}, 0}, {{1, 5, 4, 6}, 0}, {{4, 6, 3, 7}, 0}},
                 false);
  bent.hanging = body.hanging;
  const MasterSurface ridge(bent, {0});
  for (const double y : {0., .2, .5, .7, 1.})
    expect_foot(ridge, {1, y, .3}, {vec(0, 0, -1)}, .3, vec(0, 0, 1));
}



TEST(PairingFoot, TheRimOfACurvedSurfaceIsNotCutOff)
{
  // a quarter of a cylinder in facets; nodes at its ends stand off along the
  // true normal, which leaves the last facet
  for (const unsigned int n : {4u, 9u})
    for (const double r : {.8, .99, 1.01, 1.3})
      {
        std::vector<Point<3>>        points;
        std::vector<FacesOnly::Face> faces;
        for (unsigned int i = 0; i <= n; ++i)
          points.emplace_back(std::cos(M_PI / 2 * i / n),
                              std::sin(M_PI / 2 * i / n),
                              0);
        for (unsigned int i = 0; i < n; ++i)
          if (r > 1)
            faces.push_back({{i, i + 1}, 0});
          else
            faces.push_back({{i + 1, i}, 0});
        const FacesOnly     body(points, faces, false);
        const MasterSurface master(body, {0});
        for (unsigned int i = 0; i <= n; ++i)
          {
            const Tensor<1, 3> out(points[i]);
            const auto         foot =
              master.foot(Point<3>(r * out), {r > 1 ? -out : out}, limits);
            ASSERT_TRUE(foot) << i;
            EXPECT_NEAR(foot->gap,
                        std::abs(r - 1),
                        .03 * std::abs(r - 1) + .02);
            EXPECT_GT(foot->normal * out * (r > 1 ? 1 : -1), .97);
          }
      }
}



TEST(PairingFoot, SheetsHaveNoSides)
{
  const FacesOnly     wall({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}},
                       {{{0, 1}, 0}, {{1, 2}, 0}},
                       true);
  const MasterSurface master(wall, {0});
  for (const double side : {-1., 1.})
    {
      expect_foot(
        master, {.1 * side, .3, 0}, {vec(-side, 0)}, .1, vec(side, 0));
      expect_foot(master, {0, 1, 0}, {vec(-side, 0)}, 0, vec(side, 0));
      expect_foot(
        master, {-.01 * side, .3, 0}, {vec(-side, 0)}, -.01, vec(side, 0));
      // further behind is the other side
      expect_free(master, {-.1 * side, .3, 0}, {vec(-side, 0)});
      // a sheet meets a sheet from where it is
      expect_foot(
        master, {.1 * side, .3, 0}, {vec(1, 0), vec(-1, 0)}, .1, vec(side, 0));
    }
}



// also far away, beside edges and corners, and in the plane
TEST(FaceNet, EnclosesWhatIsInsideOnly)
{
  const FacesOnly body = test::cube(3);
  const FaceNet   cube(body, body.surface(body.boundary_ids()));
  EXPECT_TRUE(cube.encloses({.5, .5, .5}));
  EXPECT_TRUE(cube.encloses({.01, .99, .5}));
  EXPECT_NEAR(cube.depth({.5, .5, .1}), .1 * 3, 1e-12);
  for (const Point<3> &p : {Point<3>(1.01, .5, .5),
                            Point<3>(1, 1, 8.),
                            Point<3>(.999, .999, 8.),
                            Point<3>(-9, 2, 1e-9)})
    {
      EXPECT_FALSE(cube.encloses(p)) << p;
      EXPECT_EQ(cube.depth(p), 0) << p;
    }
  const FacesOnly square({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                         {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 3}, 0}, {{3, 0}, 0}},
                         false);
  const FaceNet   sides(square, square.surface({0}));
  EXPECT_TRUE(sides.encloses({1.9, .1, 0}));
  EXPECT_FALSE(sides.encloses({2.1, .1, 0}));
  EXPECT_FALSE(sides.encloses({1, -5, 0}));
}
