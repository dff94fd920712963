// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "faces_only.h"

using namespace conetact;
using namespace conetact::pairing;
using test::FacesOnly;

namespace
{
  /** Nodes without faces of their own. */
  class Cloud : public FacesOnly
  {
  public:
    explicit Cloud(const std::vector<Point<3>> &all)
      : FacesOnly(all, {}, false)
    {}
    bodies::Surface
    surface(const bodies::BoundaryIds &) const override
    {
      bodies::Surface result;
      for (unsigned int node = 0; node < n_nodes(); ++node)
        {
          result.nodes.emplace_back();
          result.nodes.back().node = node;
        }
      return result;
    }
  };

  /** One point at a time, against what is known of a unit square or cube. */
  void
  expect_depths(const FacesOnly   &body,
                const unsigned int dim,
                const double       edge)
  {
    const Boundary                         boundary(body);
    const Solid                            solid(boundary, body);
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> uniform(-.5, 1.5);
    for (unsigned int trial = 0; trial < 500; ++trial)
      {
        Point<3> p;
        double   depth = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            p[d]  = uniform(random);
            depth = std::min({depth, p[d], 1 - p[d]});
          }
        const Cloud    point({p});
        const Boundary node(point);
        const auto     found = solid.deepest_inside(Solid(node, point));
        EXPECT_EQ(found.has_value(), depth > 0) << p;
        if (found)
          {
            EXPECT_NEAR(found->depth, depth, 1e-14) << p;
            EXPECT_NEAR(found->edge, edge, 1e-14);
          }
      }
  }
} // namespace



TEST(PairingOverlap, IsTheDepthBelowTheNearestFace)
{
  expect_depths(test::square(), 2, 1);
  expect_depths(test::cube(1), 3, std::sqrt(2)); // of half a square
  expect_depths(test::cube(7), 3, std::sqrt(2) / 7);
}



TEST(PairingOverlap, IsThatOfTheDeepestNode)
{
  const FacesOnly body = test::cube(4);
  const Boundary  boundary(body);
  const Cloud     cloud({{.5, .5, .9}, {.5, .5, .7}, {.2, .5, .5}, {2, 0, 0}});
  const Boundary  nodes(cloud);
  const auto found = Solid(boundary, body).deepest_inside(Solid(nodes, cloud));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->depth, .3, 1e-14);
  EXPECT_EQ(found->position, Point<3>(.5, .5, .7));
  EXPECT_FALSE(Solid(nodes, cloud).deepest_inside(Solid(boundary, body)));
}
