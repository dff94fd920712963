// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/true_gap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "obstacle_fixture.h"

using namespace conetact;
using namespace conetact::pairing;

namespace
{
  /** The top of a layer at y = 0 under an obstacle, linearised. */
  std::vector<ContactNode>
  layer(const Obstacle &above, const double spacing)
  {
    std::vector<ContactNode> nodes;
    for (int i = -40; i <= 40; ++i)
      {
        ContactNode node;
        node.position      = {i * spacing, 0, 0};
        node.obstacle      = &above;
        node.spacing       = spacing;
        const auto closest = above.shape->closest(node.position, spacing);
        node.gap           = closest.gap;
        node.n             = closest.normal;
        nodes.push_back(node);
      }
    return nodes;
  }

  /**
   * The obstacle moved by d, nodes that it would penetrate by the linearised
   * gap pushed back.
   */
  std::vector<MovedNode>
  moved(const std::vector<ContactNode> &nodes, const Tensor<1, 3> &d)
  {
    std::vector<MovedNode> result;
    for (const ContactNode &node : nodes)
      {
        const double       g = node.gap - node.n * d;
        const Tensor<1, 3> u = std::min(g, 0.) * -node.n;
        result.push_back(
          {&node, u, RigidMotion::translated(d), std::max(g, 0.)});
      }
    return result;
  }

  Tensor<1, 3>
  vec(const double x, const double y)
  {
    return Tensor<1, 3>({x, y, 0.});
  }
} // namespace



TEST(PairingTrueGap, OfADiscPressedAndSwept)
{
  const Obstacle disc =
    make_obstacle("Shape = sphere|Center = 0, 10|Radius = 10");
  const auto nodes = layer(disc, .1);
  // pressed, the linearised gap is right
  EXPECT_FALSE(worst_gap_error(moved(nodes, vec(0, -.02))));
  // a sweep at constant depth: nodes ahead are hit by a wall
  const auto worst = worst_gap_error(moved(nodes, vec(2.4, -.02)));
  ASSERT_TRUE(worst);
  EXPECT_GT(std::abs(worst->actual - worst->linearised), .1);
  EXPECT_NEAR(worst->allowed, 1e-3, 1e-15);
  const std::string text = to_sentence(*worst);
  for (const char *part : {"obstacle 'disc'", "of the node at"})
    EXPECT_NE(text.find(part), text.npos) << text;
  // an indentation as deep as the layer forgives more
  EXPECT_FALSE(worst_gap_error(moved(nodes, vec(2.4, -.02)), 1000));
  // body and obstacle moved together
  auto carried = moved(nodes, vec(0, -.02));
  for (MovedNode &node : carried)
    {
      node.u += vec(7, 3);
      node.motion.translation += vec(7, 3);
    }
  EXPECT_FALSE(worst_gap_error(carried));
}



TEST(PairingTrueGap, FlatAndPrescribedOnesAreNeverOff)
{
  for (const char *shape : {"Shape = half space|Normal = 0.2, -1|Point = 0, 1",
                            "Shape = prescribed gap|Normal = 0, -1|"
                            "Gap = x^2 / 20"})
    {
      const Obstacle plate = make_obstacle(shape);
      const auto     nodes = layer(plate, .1);
      for (const auto &d : {vec(0, -.5), vec(30, -2), vec(-3, 1)})
        for (const MovedNode &node : moved(nodes, d))
          {
            EXPECT_FALSE(worst_gap_error({node}));
            EXPECT_NEAR(true_gap(node),
                        node.node->gap + (node.u - d) * node.node->n,
                        1e-12);
          }
    }
}



TEST(PairingTrueGap, ImplicitShapesAreThoseTheyDescribe)
{
  const Obstacle disc =
    make_obstacle("Shape = sphere|Center = 0, 10|Radius = 10");
  const Obstacle other =
    make_obstacle("Shape = implicit|Function = sqrt(x^2 + (y - 10)^2) - 10");
  const auto a = layer(disc, .1), b = layer(other, .1);
  for (const auto &d : {vec(0, -.02), vec(.3, -.02), vec(2.4, -.02)})
    {
      const auto disc_moved = moved(a, d), other_moved = moved(b, d);
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(true_gap(disc_moved[i]), true_gap(other_moved[i]), 1e-8);
      EXPECT_EQ(worst_gap_error(disc_moved).has_value(),
                worst_gap_error(other_moved).has_value());
    }
  // no gradient at the node's place: no error, but a gap that is off
  const Obstacle flat =
    make_obstacle("Shape = implicit|Function = if(y < -1, 1, -y)");
  ContactNode node;
  node.position = {0, -.5, 0};
  node.obstacle = &flat;
  node.spacing  = .1;
  node.gap      = .5;
  EXPECT_GT(true_gap({&node, vec(0, -5), RigidMotion(), 5.5}), 1e100);
}



TEST(PairingTrueGap, OfANodeAtTheCentre)
{
  const Obstacle hole =
    make_obstacle("Shape = cylinder|Radius = 2|Side = inside", 3);
  ContactNode node;
  node.position = {2, 0, 1};
  node.obstacle = &hole;
  node.spacing  = .1;
  node.n        = vec(-1, 0);
  EXPECT_DOUBLE_EQ(true_gap({&node, vec(-2, 0), RigidMotion(), 2}), 2);
}



TEST(PairingTrueGap, OfAnObstacleThatTurns)
{
  // a floor that turns by 90 degrees about (1, 0) becomes a wall
  const Obstacle floor = make_obstacle("Shape = half space|Normal = 0, 1");
  ContactNode    node;
  node.position = {3, .5, 0};
  node.obstacle = &floor;
  node.spacing  = .1;
  const RigidMotion motion =
    RigidMotion::turned(vec(.25, 0),
                        Tensor<1, 3>({0., 0., M_PI / 2}),
                        {1, 0, 0});
  EXPECT_NEAR(true_gap({&node, vec(0, 0), motion, .5}), -(3 - 1.25), 1e-15);
  EXPECT_NEAR(true_gap({&node, vec(-4, 7), motion, .5}), 2.25, 1e-15);
  const Point<3> p(.3, .7, 2);
  EXPECT_LE(motion.to_own(motion.to_space(p)).distance(p), 1e-15);
  EXPECT_LE((motion.to_space(Point<3>(2, 0, 0)) - Point<3>(1.25, 1, 0)).norm(),
            1e-15);
  EXPECT_LE((motion.direction_to_space(vec(0, 1)) - vec(-1, 0)).norm(), 1e-15);
  EXPECT_LE((motion.direction_to_own(vec(-1, 0)) - vec(0, 1)).norm(), 1e-15);
  // a translation rounds nothing
  const auto moved = RigidMotion::translated(vec(.1, .2));
  EXPECT_EQ(moved.displacement(p), vec(.1, .2));
  EXPECT_EQ(moved.relative(p, vec(.3, 0)), vec(.3, 0) - vec(.1, .2));
}
