// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/pairing/closest_point.h"
#include "conetact/pairing/master_surface.h"

#include <gtest/gtest.h>

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::pairing;
using namespace conetact::test;

namespace
{
  std::string
  block(const unsigned int dim, const bool named = true)
  {
    const std::string simplices = named ? "_with_simplices" : "";
    return dim == 2 ? "Generator = subdivided_hyper_rectangle" + simplices +
                        "|Arguments = 3, 2 : 0, 0 : 3, 1 : true" :
                      "Generator = subdivided_hyper_rectangle" + simplices +
                        "|Arguments = 3, 2, 2 : 0, 0, 0 : 3, 1, 1 : true";
  }

  double
  area_of(const Structure &body, const BoundaryIds &ids)
  {
    double sum = 0;
    for (const SurfaceNode &node : body.surface(ids).nodes)
      sum += node.area;
    return sum;
  }

  std::unique_ptr<Structure>
  simplices(const unsigned int dim, const std::string &mesh)
  {
    return make_body(
      dim,
      mesh,
      "Young modulus = 5|Poisson ratio = 0.3|Expansion coefficient"
      " = 1e-3",
      "automatic");
  }
} // namespace

TEST(Simplices, SidesAreColouredAsThoseOfQuadrilaterals)
{
  for (const unsigned int dim : {2u, 3u})
    {
      const auto body  = simplices(dim, block(dim)),
                 other = simplices(dim, block(dim, false));
      EXPECT_NE(body->description().find("P1"), std::string::npos);
      EXPECT_EQ(body->n_nodes(), other->n_nodes());
      EXPECT_EQ(body->boundary_ids(), other->boundary_ids());
      for (const unsigned int id : body->boundary_ids())
        {
          EXPECT_NEAR(area_of(*body, {id}), area_of(*other, {id}), 1e-14);
          EXPECT_NEAR((body->surface({id}).nodes[0].normal -
                       other->surface({id}).nodes[0].normal)
                        .norm(),
                      0,
                      1e-14);
        }
    }
}

TEST(Simplices, LoadsHaveTheirSums)
{
  for (const unsigned int dim : {2u, 3u})
    for (const std::string finer : {"0", "1"})
      {
        const auto body =
          simplices(dim, block(dim) + "|Global refinements = " + finer);
        Eigen::VectorXd f = Eigen::VectorXd::Zero(body->n_dofs());
        // linear in x: moments count, too
        body->add(Action::body_force([](const Point<3> &x) {
                    return Tensor<1, 3>({0, x[0], 0});
                  }),
                  f);
        EXPECT_NEAR(f.sum(), 4.5, 1e-13);
        f.setZero();
        body->add(Action::traction({dim == 2 ? 3u : 5u},
                                   [](const Point<3>     &x,
                                      const Tensor<1, 3> &n) {
                                     return x[0] * x[0] * n;
                                   }),
                  f);
        EXPECT_NEAR(f.sum(), 9, 1e-13);
        f.setZero();
        EXPECT_TRUE(
          body->add(Action::point_force(Point<3>(.3, .4, dim == 3 ? .2 : 0.),
                                        Tensor<1, 3>({1, 0, 0})),
                    f));
        EXPECT_NEAR(f.sum(), 1, 1e-14);
        EXPECT_FALSE(body->add(Action::point_force(Point<3>(3.1, .4, 0.),
                                                   Tensor<1, 3>({1, 0, 0})),
                               f));
      }
}

TEST(Simplices, FreeExpansionIsFreeOfStress)
{
  for (const unsigned int dim : {2u, 3u})
    {
      const auto      body   = simplices(dim, block(dim));
      Eigen::VectorXd forces = Eigen::VectorXd::Zero(body->n_dofs());
      body->add(Action::initial_strains([](const Point<3> &) {
                  return InitialStrain{{}, 10.};
                }),
                forces);
      // in plane strain the strain along z is held: 1 + nu times as much
      const double          strain = dim == 2 ? 1.3e-2 : 1e-2;
      const Eigen::VectorXd u      = interpolate(*body, [&](const Point<3> &x) {
        return strain * Tensor<1, 3>(x);
      });
      EXPECT_LE((internal_forces(*body, u) - forces).norm(),
                1e-13 * forces.norm());
    }
}

TEST(Simplices, OnlyWholeMeshesAreRefined)
{
  EXPECT_THROW(simplices(2, block(2) + "|Refinement boxes = 0, 0 : 1, 1 : 1"),
               InputError);
  EXPECT_THROW(simplices(3, block(3) + "|Refinement distance = 4 : .1 : 1"),
               InputError);
  EXPECT_THROW(make_body(2, block(2), "Young modulus = 1", "Q1"), InputError);
}

TEST(Simplices, NearestPointOfATriangle)
{
  const std::vector<Point<3>> corners = {Point<3>(0, 0, 0),
                                         Point<3>(2, 0, 0),
                                         Point<3>(0, 1, 1)};
  for (const Point<3> &p : {Point<3>(.4, .3, .9),
                            Point<3>(-1, .2, .3),
                            Point<3>(2, 1, 0),
                            Point<3>(5, -1, 2),
                            Point<3>(1, -3, -1)})
    {
      double             least = 1e300;
      constexpr unsigned n     = 400;
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; i + j <= n; ++j)
          {
            const double   a = double(i) / n, b = double(j) / n;
            const Point<3> x(2 * a, b, b);
            least = std::min(least, x.distance(p));
          }
      const ClosestPoint found = closest_point(corners, p);
      EXPECT_NEAR(found.distance, least, 1e-4);
      const auto weights = shape_values(3, found.at);
      Point<3>   there;
      for (unsigned int i = 0; i < 3; ++i)
        there += weights[i] * Tensor<1, 3>(corners[i]);
      EXPECT_LE(there.distance(found.point), 1e-14);
    }
}

TEST(Simplices, AreMasters)
{
  const auto                  body = simplices(3, block(3));
  const MasterSurface         top(*body, {5});
  const MasterSurface::Limits limits{1, .5, .1, false};
  for (const Point<3> &p : {Point<3>(.1, .2, 1.1),
                            Point<3>(1.7, .9, 1.2),
                            Point<3>(1, .5, 1.05),
                            Point<3>(3, 1, 1.01)})
    {
      const auto foot = top.foot(p, {Tensor<1, 3>({0, 0, -1})}, limits);
      ASSERT_TRUE(foot);
      EXPECT_NEAR(foot->gap, p[2] - 1, 1e-14);
      Tensor<1, 3> at;
      for (const auto &[node, weight] : foot->masters)
        at += weight * body->position(node);
      EXPECT_LE((at - Tensor<1, 3>({p[0], p[1], 1})).norm(), 1e-14);
    }
  // beside the surface nothing is met
  EXPECT_FALSE(
    top.foot(Point<3>(3.2, .5, 1.1), {Tensor<1, 3>({0, 0, -1})}, limits));
}
