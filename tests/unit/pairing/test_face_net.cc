// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/face_net.h"

#include <gtest/gtest.h>

#include "faces_only.h"

using namespace conetact;
using namespace conetact::pairing;
using test::FacesOnly;

namespace
{
  FaceNet
  net_of(const FacesOnly &body)
  {
    return FaceNet(body, body.surface(body.boundary_ids()));
  }
} // namespace



/* Middles of six-node triangles stand in another order than their edges. */
TEST(FaceNet, JoinsTrianglesOfSecondDegreeAlongAllEdges)
{
  std::vector<Point<3>> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const unsigned int    middle[4][4] = {{0, 4, 5, 6},
                                        {4, 0, 7, 8},
                                        {5, 7, 0, 9},
                                        {6, 8, 9, 0}};
  for (unsigned int a = 0; a < 4; ++a)
    for (unsigned int b = a + 1; b < 4; ++b)
      points.push_back(points[a] + .5 * (points[b] - points[a]));
  std::vector<FacesOnly::Face> faces;
  const unsigned int           corners[4][3] = {{0, 2, 1},
                                                {0, 1, 3},
                                                {0, 3, 2},
                                                {1, 2, 3}};
  for (const auto &c : corners)
    faces.push_back({{c[0],
                      c[1],
                      c[2],
                      middle[c[0]][c[1]],
                      middle[c[1]][c[2]],
                      middle[c[2]][c[0]]},
                     0});
  const FacesOnly tetrahedron(points, faces, false);
  const FaceNet   net = net_of(tetrahedron);
  for (const FaceNet::Face &face : net.all())
    for (const FaceNet::Edge &edge : face.edges)
      EXPECT_EQ(edge.partners.size(), 1U);
  // beside an edge the sum of normals of both faces tells the side
  EXPECT_LT(net.signed_distance({.2, .2, .2}), 0);
  EXPECT_GT(net.signed_distance({-.1, -.1, .5}), 0);
}



/* The first ball around p reaches the large face, not yet the small one. */
TEST(FaceNet, FindsASmallFaceThatIsNearerThanALargeOne)
{
  const FacesOnly faces({{-.7, -.7, 0},
                         {.7, -.7, 0},
                         {-.7, .7, 0},
                         {.7, .7, 0},
                         {-.05, -.05, 3.4},
                         {.05, -.05, 3.4},
                         {-.05, .05, 3.4},
                         {.05, .05, 3.4}},
                        {{{0, 1, 2, 3}, 0}, {{4, 5, 6, 7}, 0}},
                        true);
  const auto      nearest = net_of(faces).nearest({0, 0, 1.9});
  EXPECT_EQ(nearest.face, 1U);
  EXPECT_NEAR(nearest.distance, 1.5, 1e-12);
}
