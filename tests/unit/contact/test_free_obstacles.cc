// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/coordinates.h"
#include "conetact/contact/free_obstacles.h"
#include "conetact/contact/rigid_motions.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::application;
using namespace conetact::bodies;
using namespace conetact::contact;
using test::expect_near;
using test::section;
using test::vector;

namespace
{
  /** A triangle of bars on a floor that is free in y and about z. */
  std::unique_ptr<Scene>
  pressed_from_below()
  {
    return test::make_scene(
      "set Dimension = 2\nset Bodies = frame\nset Obstacles = floor\n"
      "set Contacts = feet\nset Supports = top\n" +
      test::triangle() + test::held_top() +
      section("Obstacle floor",
              "Shape = half space|Normal = 0, 1|Point = 0, -0.1|Free = y, rz|"
              "Reference point = 3, -1|Force = 0 ; 4*t|Moment = t^2|"
              "Displacement = 0.1*t ; 0") +
      section("Contact feet",
              "Body = frame|Boundary ids = 1|Obstacle = floor|"
              "Friction coefficient = 0.2"));
  }
} // namespace



TEST(FreeObstacles, AreRigidBodiesBehindTheOthers)
{
  const auto           scene  = pressed_from_below();
  const model::Bodies &bodies = scene->bodies;
  ASSERT_EQ(bodies.structures.size(), 2u);
  EXPECT_EQ(bodies.n_elastic(), 1u);
  EXPECT_TRUE(bodies.is_rigid(1));
  EXPECT_EQ(bodies.called(0), "body 'frame'");
  EXPECT_EQ(bodies.called(1), "obstacle 'floor'");
  const Structure &floor = *bodies.structures[1];
  // the reference point, two feet, two nodes that span the axes
  ASSERT_EQ(floor.n_nodes(), 5u);
  expect_near(floor.position(0), vector(3, -1));
  for (const pairing::ContactNode &node : bodies.contact_nodes)
    {
      ASSERT_EQ(node.masters.size(), 1u);
      EXPECT_EQ(node.master, 1u);
      expect_near(floor.position(node.masters[0].first),
                  node.position - vector(0, .1));
    }
}



TEST(FreeObstacles, HaveTheirLoadsAtTheReferencePoint)
{
  const auto            scene = pressed_from_below();
  const Eigen::VectorXd f     = scene->obstacle_forces(2);
  ASSERT_EQ(f.size(), 6 + 15);
  EXPECT_EQ(f.head(6).norm(), 0);
  EXPECT_EQ(f[6], 0);
  EXPECT_EQ(f[7], 8);
  EXPECT_EQ(f[8], 4);
  EXPECT_EQ(f.tail(12).norm(), 0);
}



TEST(FreeObstacles, MoveWhereTheyAreFreeAndAsPrescribed)
{
  const auto          scene = pressed_from_below();
  const NodeRules     rules(scene->bodies, {1, 2});
  const ContactPoints points(scene->bodies, rules, {1, 2});
  const Coordinates   coordinates(scene->bodies, rules);
  const RigidMotions  motions(scene->bodies, rules, points);
  EXPECT_EQ(coordinates.n_unknowns(), 4); // two feet; the top is held
  // the frame may turn about its top
  ASSERT_EQ(motions.n_free(), 3);
  EXPECT_EQ(motions.body_of_free(), (std::vector<unsigned int>{0, 1, 1}));
  // its reference point is placed by what is prescribed
  EXPECT_NEAR(motions.at(motions.placement(2), 1, 0)[0], .2, 1e-14);
  // contacts see a free motion with the opposite sign, at the feet
  for (Eigen::Index k = 1; k < 3; ++k)
    {
      const auto amounts = motions.of_free(Eigen::Vector3d::Unit(k));
      EXPECT_NEAR(motions.at(amounts, 1, 0)[0], 0, 1e-14);
      for (const ContactPoint &point : points)
        {
          const Tensor<1, 3> u =
            motions.at(amounts, 1, point.node->masters[0].first);
          expect_near(motions.at(amounts, 1, 0) +
                        cross_product_3d(motions.turn(amounts, 1),
                                         point.node->foot() -
                                           Point<3>(3, -1, 0)),
                      u);
          for (std::size_t i = 0; i < point.dual.size(); ++i)
            EXPECT_NEAR(
              motions.seen()(point.first + static_cast<Eigen::Index>(i), k),
              -u * point.dual[i],
              1e-14);
        }
    }
}



TEST(FreeObstacles, ForcesOnThemHaveOneResultant)
{
  const auto        scene = pressed_from_below();
  const NodeRules   rules(scene->bodies, {1});
  const Coordinates coordinates(scene->bodies, rules);
  Eigen::VectorXd   f = Eigen::VectorXd::Zero(coordinates.n_dofs());
  // on the feet (0, -0.1) and (2, -0.1), about (3, -1)
  const Eigen::Index one = coordinates.dof(1, 1), other = coordinates.dof(1, 2);
  f[one]       = 5;
  f[one + 1]   = 7;
  f[other + 1] = -2;
  coordinates.unhang(f);
  const Eigen::Index first = coordinates.dof(1, 0);
  EXPECT_NEAR(f[first], 5, 1e-15);
  EXPECT_NEAR(f[first + 1], 5, 1e-15);
  EXPECT_NEAR(f[first + 2], -3 * 7 - .9 * 5 + 1 * 2, 1e-14);
  EXPECT_EQ(f.segment(one, 6).norm(), 0);
}
