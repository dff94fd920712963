// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/bent_face.h"
#include "conetact/pairing/projected_face.h"

#include <gtest/gtest.h>

using namespace conetact;
using namespace conetact::pairing;

namespace
{
  /** On the paraboloid z = (x^2 + y^2) / 10, by its nodes exactly. */
  double
  height(const double x, const double y)
  {
    return (x * x + y * y) / 10;
  }

  Point<3>
  on_paraboloid(const double x, const double y)
  {
    return {x, y, height(x, y)};
  }

  FaceNet::Face
  triangle()
  {
    FaceNet::Face face;
    face.nodes       = {0, 1, 2, 3, 4, 5};
    face.n_functions = 3;
    face.corners     = {on_paraboloid(0, 0),
                        on_paraboloid(1, 0),
                        on_paraboloid(0, 1)};
    face.middles     = {on_paraboloid(.5, 0),
                        on_paraboloid(.5, .5),
                        on_paraboloid(0, .5)};
    face.outward     = Tensor<1, 3>({0., 0., 1.});
    face.centre      = on_paraboloid(1. / 3, 1. / 3);
    return face;
  }
} // namespace



TEST(BentFace, FeetAreWhereNormalsLeadFrom)
{
  const FaceNet::Face face = triangle();
  for (const double away : {-.3, 0., .2, 1.})
    {
      const double x = .3, y = .4;
      Tensor<1, 3> normal({-x / 5, -y / 5, 1.});
      normal /= normal.norm();
      const Point<3> p    = on_paraboloid(x, y) + away * normal;
      const auto     foot = foot_on_bent(face, p, {{.3, .3}});
      ASSERT_TRUE(foot);
      EXPECT_NEAR((foot->point - on_paraboloid(x, y)).norm(), 0, 1e-12);
      EXPECT_NEAR((foot->normal - normal).norm(), 0, 1e-12);
      EXPECT_NEAR(foot->at[0], x, 1e-12);
    }
}

TEST(BentFace, IsContinuedALittleBeyondItsEdgesOnly)
{
  const FaceNet::Face face = triangle();
  EXPECT_TRUE(foot_on_bent(face, on_paraboloid(-.02, .5), {{0, .5}}));
  EXPECT_FALSE(foot_on_bent(face, on_paraboloid(-.2, .5), {{0, .5}}));
}

TEST(BentFace, IsSeenWhereItIsFromAPlaneThatIsAskew)
{
  const FaceNet::Face face = triangle();
  Tensor<1, 3>        normal({.1, -.05, 1.});
  normal /= normal.norm();
  const ProjectionPlane plane(Point<3>(), normal, false);
  const ProjectedFace   seen_face(face, plane);
  const Point<3>        p    = on_paraboloid(.25, .35);
  const auto            over = seen_face.over(plane.project(p));
  EXPECT_NEAR(over.height, plane.height(p), 1e-12);
  EXPECT_NEAR(over.local[0], .25, 1e-12);
  // by the local coordinates of its chords it is beside that
  const auto at = seen_face.at(plane.project(p));
  EXPECT_GT(at.place.distance(plane.project(p)), 1e-4);
  const Tensor<1, 3> of_paraboloid({-.05, -.07, 1.});
  EXPECT_NEAR(
    (plane.in_space(over.normal) - of_paraboloid / of_paraboloid.norm()).norm(),
    0,
    1e-12);
}
