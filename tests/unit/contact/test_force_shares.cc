// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/force_shares.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;
using solvers::NodeState;

namespace
{
  /** A block in the corner of a floor and a wall. */
  std::unique_ptr<application::Scene>
  corner(const std::string &friction)
  {
    const auto side = [&](const std::string &name,
                          const std::string &id,
                          const std::string &normal) {
      return test::section("Obstacle " + name,
                           "Shape = half space|Normal = " + normal) +
             test::section("Contact " + name,
                           "Body = block|Boundary ids = " + id +
                             "|Obstacle = " + name +
                             "|Friction coefficient = " + friction);
    };
    return test::make_scene(
      "set Dimension = 2\nset Bodies = block\nset Obstacles = floor, wall\n"
      "set Contacts = floor, wall\nsubsection Body block\n" +
      test::section("Mesh",
                    "Generator = subdivided_hyper_rectangle|"
                    "Arguments = 2, 2 : 0, 0 : 1, 1 : true") +
      test::section("Material", "Young modulus = 1000|Poisson ratio = 0.3") +
      "end\n" + side("floor", "2", "0, 1") + side("wall", "0", "1, 0"));
  }

  /** Whether all forces are determined where every node is in a state. */
  bool
  determined(const std::string &friction,
             const NodeState    on_floor,
             const NodeState    at_wall,
             const double       r_floor,
             const double       r_wall)
  {
    const auto          scene = corner(friction);
    const NodeRules     rules(scene->bodies, {1});
    const ContactPoints points(scene->bodies, rules, {1});
    EXPECT_EQ(points.size(), 6u);
    std::vector<NodeState> states(3, on_floor);
    states.resize(6, at_wall);
    Eigen::VectorXd r = Eigen::VectorXd::Constant(points.n_unknowns(), r_floor);
    r.tail(points.n_unknowns() / 2).setConstant(r_wall);
    return undetermined_share(points, states, r) == nullptr;
  }

  bool
  determined(const std::string &friction, const NodeState state)
  {
    return determined(friction, state, state, 1, 1);
  }
} // namespace



TEST(ForceShares, ACornerThatSticksToBothSides)
{
  EXPECT_FALSE(determined("0.3", NodeState::stick));
}



TEST(ForceShares, AreDeterminedWithoutFrictionAndWhereNothingTouches)
{
  EXPECT_TRUE(determined("0", NodeState::stick));
  EXPECT_TRUE(determined("0.3", NodeState::open));
}



TEST(ForceShares, AWallThatOnlyTouchesMayPressWhatSticks)
{
  EXPECT_FALSE(determined("0.3", NodeState::stick, NodeState::slip, 1, 0));
  EXPECT_TRUE(determined("0.3", NodeState::stick, NodeState::open, 1, 0));
  EXPECT_TRUE(determined("0.3", NodeState::stick, NodeState::slip, 0, 0));
}
