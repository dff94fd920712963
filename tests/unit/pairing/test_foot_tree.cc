// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/foot_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "faces_only.h"

using namespace conetact;
using namespace conetact::pairing;
using test::FacesOnly;

namespace
{
  FaceNet
  whole(const FacesOnly &body)
  {
    return {body, body.surface(body.boundary_ids())};
  }

  /** A cube whose nodes are moved. */
  template <class Move>
  FacesOnly
  bent_cube(const unsigned int n, const Move &move)
  {
    const FacesOnly              straight = test::cube(n);
    std::vector<Point<3>>        points;
    std::vector<FacesOnly::Face> faces;
    for (unsigned int node = 0; node < straight.n_nodes(); ++node)
      points.push_back(move(straight.position(node)));
    for (const unsigned int id : straight.boundary_ids())
      for (const bodies::SurfaceFace &face : straight.surface({id}).faces)
        faces.push_back({face.nodes, id});
    return FacesOnly(std::move(points), std::move(faces), false);
  }

  /** Tells whether p stands off a face along its normal or one of its
   * neighbours, by the mean normals of both. */
  bool
  is_along_normals(const FaceNet::Face &face, const Point<3> &p)
  {
    const Tensor<1, 3> arm    = p - face.centre;
    const Tensor<1, 3> beside = arm - (arm * face.outward) * face.outward;
    return beside.norm() <= 1.1 * face.radius + face.turn * arm.norm();
  }

  /** No face that has a nearest point of the surface is left out. */
  void
  expect_all_feet(const FaceNet &net, const unsigned int dim)
  {
    const FootTree                         tree(net);
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (unsigned int trial = 0; trial < 2000; ++trial)
      {
        const double   far = trial % 3 == 0 ? 20 : 1.2;
        const Point<3> p(.5 + far * uniform(random),
                         .5 + far * uniform(random),
                         dim == 2 ? 0 : .5 + far * uniform(random));
        const auto     found = tree.faces_with_foot(net, p);
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
        for (std::size_t f = 0; f < net.all().size(); ++f)
          if (is_along_normals(net.all()[f], p) &&
              !net.feature(net.project(f, p), p).empty())
            {
              EXPECT_TRUE(std::binary_search(found.begin(), found.end(), f))
                << p << " has a foot on the face at " << net.all()[f].centre;
            }
      }
  }
} // namespace



TEST(PairingFootTree, LeavesOutNoFaceThatHasAFoot)
{
  expect_all_feet(whole(test::square()), 2);
  expect_all_feet(whole(test::cube(1)), 3);
  expect_all_feet(whole(test::cube(5)), 3);
  // flat, and sheared
  expect_all_feet(whole(bent_cube(4,
                                  [](const Point<3> &x) {
                                    return Point<3>(x[0] + .7 * x[1],
                                                    x[1],
                                                    .02 * x[2]);
                                  })),
                  3);
  // round on all sides
  expect_all_feet(whole(bent_cube(4,
                                  [](const Point<3> &x) {
                                    const Tensor<1, 3> arm =
                                      x - Point<3>(.5, .5, .5);
                                    double most = 0;
                                    for (unsigned int d = 0; d < 3; ++d)
                                      most = std::max(most, std::abs(arm[d]));
                                    return arm.norm() > 0 ?
                                             Point<3>(.5, .5, .5) +
                                               most / arm.norm() * arm :
                                             x;
                                  })),
                  3);
  // warped faces, edges that go in and out
  expect_all_feet(whole(bent_cube(4,
                                  [](const Point<3> &x) {
                                    return x + Tensor<1, 3>(
                                                 {.05 * std::sin(9 * x[1]),
                                                  .05 * std::sin(11 * x[2]),
                                                  .05 * std::sin(8 * x[0])});
                                  })),
                  3);
  // a body with a notch
  expect_all_feet(whole(bent_cube(4,
                                  [](const Point<3> &x) {
                                    return x[0] == .5 && x[2] == 1 ?
                                             Point<3>(x[0], x[1], .8) :
                                             x;
                                  })),
                  3);
}



TEST(PairingFootTree, AsksFewFaces)
{
  const unsigned int n = 32;
  const FaceNet      net(whole(test::cube(n)));
  const FootTree     tree(net);
  // Over the middle of a side: faces on the line through the point, on two
  // sides; none of those at edges.
  EXPECT_LE(tree.faces_with_foot(net, {.51, .52, 3}).size(), 64u);
  // Seen from a corner it is the edges there, at most.
  EXPECT_LE(tree.faces_with_foot(net, {3, 3, 3}).size(), 6 * n);
}
