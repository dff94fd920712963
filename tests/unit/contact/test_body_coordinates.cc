// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/body_coordinates.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

TEST(BodyCoordinates, LeaveOutWhatSupportsHold)
{
  const auto scene =
    test::make_scene(test::triangle_on_floor("set Supports = top\n",
                                             test::held_top("0.1*t ; 0")));
  const NodeRules       rules(scene->bodies, {1});
  const Coordinates     coordinates(scene->bodies, rules);
  const BodyCoordinates own(scene->bodies, coordinates);
  ASSERT_EQ(own.n_unknowns(), 4);
  EXPECT_EQ(own.begin(0), 0);
  EXPECT_EQ(own.end(0), 4);
  EXPECT_EQ(own.unknowns_of(0, 2).first, own.unknowns_of(0, 2).second);
  const auto [first, end] = own.unknowns_of(0, 1);
  ASSERT_EQ(end - first, 2);
  EXPECT_EQ(own.node_of(first), coordinates.number(0, 1));
  const Eigen::VectorXd u = own.expand(Eigen::VectorXd::Unit(4, first));
  EXPECT_NEAR(u[coordinates.dof(0, 1)], 1, 1e-15);
  EXPECT_NEAR(u.norm(), 1, 1e-15);
}



TEST(BodyCoordinates, ValuesTakeBackWhatIsExpanded)
{
  const auto scene = test::make_scene(
    test::triangle_on_floor("set Supports = top\n", test::held_top()));
  const NodeRules       rules(scene->bodies, {1});
  const Coordinates     coordinates(scene->bodies, rules);
  const BodyCoordinates own(scene->bodies, coordinates);
  const Eigen::Vector4d p(1, -2, 3, 5);
  EXPECT_LE((own.values(own.expand(p)) - p).norm(), 1e-14);
}
