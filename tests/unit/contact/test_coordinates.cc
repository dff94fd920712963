// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/coordinates.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::contact;

namespace
{
  Eigen::VectorXd
  unit(const Eigen::Index n, const Eigen::Index k)
  {
    return Eigen::VectorXd::Unit(n, k);
  }
} // namespace



TEST(Coordinates, SupportsAreEliminated)
{
  const auto scene =
    test::make_scene(test::triangle_on_floor("set Supports = top\n",
                                             test::held_top("0.1*t ; -0.2*t")));
  const NodeRules   rules(scene->bodies, {1});
  const Coordinates coordinates(scene->bodies, rules);
  EXPECT_EQ(coordinates.n_dofs(), 6);
  EXPECT_EQ(coordinates.n_unknowns(), 4);
  EXPECT_EQ(coordinates.contact_axes().n_unknowns(), 0);
  EXPECT_EQ(coordinates.dof(0, 2), 4);
  EXPECT_EQ(coordinates.locate(coordinates.number(0, 1)),
            std::make_pair(0U, 1U));
  EXPECT_NE(coordinates.rule(0, 2), nullptr);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
  expected.tail(2) << .2, -.4;
  EXPECT_LE((coordinates.prescribed(2) - expected).norm(), 1e-15);
  // each unknown moves one dof of a foot, none moves the top
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(6);
  for (Eigen::Index k = 0; k < 4; ++k)
    moved += coordinates.expand(unit(4, k));
  EXPECT_EQ(moved.head(4), Eigen::VectorXd::Ones(4));
  EXPECT_EQ(moved.tail(2), Eigen::VectorXd::Zero(2));
  // and the forces on it meet no unknown
  EXPECT_EQ(coordinates.restrict(unit(6, 5)), Eigen::VectorXd::Zero(4));
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
  EXPECT_LE((coordinates.held_part(ones) - (ones - moved)).norm(), 1e-15);
}



TEST(Coordinates, ContactUnknownsComeLastInTheirFrames)
{
  const auto          scene = test::make_scene(test::triangle_on_floor(
    "set Supports = top\n", test::held_top(), "|Friction coefficient = 0.2"));
  const NodeRules     rules(scene->bodies, {1});
  const ContactPoints points(scene->bodies, rules, {1});
  const Coordinates   coordinates(scene->bodies, rules, &points);
  ASSERT_EQ(coordinates.n_unknowns(), 4);
  EXPECT_EQ(coordinates.contact_axes().n_unknowns(), 4);
  for (const ContactPoint &point : points)
    for (Eigen::Index k = 0; k < 2; ++k)
      {
        const Eigen::Index first = coordinates.dof(0, point.node->node);
        const auto         u     = coordinates.expand(unit(4, point.first + k));
        EXPECT_EQ(u.segment(first, 2).norm(), u.norm());
        EXPECT_EQ(u[first + k], 1); // t1 = e_x, n = e_y
      }
}



// the left of two cells is divided: a node hangs on the middle of the edge
TEST(Coordinates, AHangingNodeIsBetweenItsMasters)
{
  const auto scene = test::make_scene(
    "set Dimension = 2\nset Bodies = block\nset Supports = left\n"
    "set Loads = weight\nsubsection Body block\n" +
    test::section("Mesh",
                  "Generator = subdivided_hyper_rectangle|"
                  "Arguments = 2, 1 : 0, 0 : 2, 1 : true|"
                  "Refinement boxes = 0, 0 : 0.9, 1 : 1") +
    test::section("Material", "Young modulus = 1|Poisson ratio = 0") + "end\n" +
    test::section("Load weight",
                  "Body = block|Kind = body force|Value = 0 ; -1") +
    test::section("Support left",
                  "Body = block|Boundary ids = 0|Directions = x, y"));
  const Structure  &body = *scene->bodies.structures[0];
  const NodeRules   rules(scene->bodies, {1});
  const Coordinates coordinates(scene->bodies, rules);
  ASSERT_EQ(body.hanging_nodes().size(), 1);
  const HangingNode &hanging = body.hanging_nodes()[0];
  EXPECT_LE(body.position(hanging.node).distance(Point<3>(1, .5, 0)), 1e-15);
  EXPECT_EQ(coordinates.n_unknowns(), 2 * (11 - 3 - 1));

  Eigen::VectorXd q(coordinates.n_unknowns());
  for (Eigen::Index k = 0; k < q.size(); ++k)
    q[k] = static_cast<double>(k * k);
  const Eigen::VectorXd u  = coordinates.expand(q);
  const auto            at = [&](const unsigned int node) {
    return u.segment(coordinates.dof(0, node), 2);
  };
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto &[master, weight] : hanging.masters)
    {
      EXPECT_EQ(weight, .5);
      mean += .5 * at(master);
    }
  EXPECT_LE((at(hanging.node) - mean).norm(), 1e-14 * mean.norm());

  Eigen::VectorXd f = unit(u.size(), coordinates.dof(0, hanging.node));
  coordinates.unhang(f);
  for (const auto &[master, weight] : hanging.masters)
    EXPECT_EQ(f[coordinates.dof(0, master)], weight);
  EXPECT_EQ(f.sum(), 1);
}
