// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_history.h"
#include "conetact/contact/preloads.h"

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
  std::string
  block(const std::string &name, const std::string &corners)
  {
    return "subsection Body " + name + "\n" +
           section(
             "Mesh",
             "Generator = subdivided_hyper_rectangle|Arguments = 2, 1 : " +
               corners + " : true") +
           section("Material", "Young modulus = 10|Poisson ratio = 0.3") +
           "end\n";
  }

  /** A bolt in two halves, the lower one held below, the upper one above or
   * free. */
  std::unique_ptr<Scene>
  bolt(const bool is_held)
  {
    return test::make_scene(
      std::string("set Dimension = 2\nset Bodies = lower, upper\n"
                  "set Obstacles = plate\nset Contacts = cut, head\n") +
      "set Supports = foot" + (is_held ? ", top" : "") + "\n" +
      block("lower", "0, 0 : 2, 1") + block("upper", "0, 1 : 2, 2") +
      section("Obstacle plate",
              "Shape = half space|Normal = 0, -1|Point = 0, 3") +
      section("Contact head",
              "Body = upper|Boundary ids = 3|Obstacle = plate") +
      section("Contact cut",
              "Body = upper|Boundary ids = 2|Master body = lower|"
              "Master boundary ids = 3|Kind = tie|Preload = 5*t|"
              "Preload axis = 0, -2|Preload locked from = 1") +
      section("Support foot", "Body = lower|Boundary ids = 2") +
      (is_held ? section("Support top", "Body = upper|Boundary ids = 3") : "") +
      section("Time", "End = 2|Increments = 2"));
  }
} // namespace



TEST(Preloads, AreRigidBodiesBehindTheOthers)
{
  const auto           scene  = bolt(true);
  const model::Bodies &bodies = scene->bodies;
  ASSERT_EQ(bodies.structures.size(), 3u);
  EXPECT_EQ(bodies.n_elastic(), 2u);
  EXPECT_EQ(bodies.n_free_obstacles(), 0u);
  EXPECT_EQ(bodies.called(1), "body 'upper'");
  EXPECT_EQ(bodies.called(2), "'preload cut'");
  ASSERT_EQ(bodies.cuts.size(), 1u);
  const model::Cut &cut = bodies.cuts[0];
  expect_near(cut.axis, vector(0, 1)); // from the master to the body
  EXPECT_FALSE(cut.is_due(.5));
  EXPECT_TRUE(cut.is_due(1));
  EXPECT_FALSE(cut.is_locked_after(1));
  EXPECT_TRUE(cut.is_locked_after(2));
  expect_near(bodies.structures[2]->position(0), vector(1, 1));
  for (const pairing::ContactNode &node : bodies.contact_nodes)
    EXPECT_EQ(node.opening.has_value(), node.contact == 0);
}



TEST(Preloads, TheirTensionClosesTheCut)
{
  const auto            scene = bolt(true);
  const Eigen::VectorXd one   = scene->obstacle_forces(1),
                        two   = scene->obstacle_forces(2);
  ASSERT_EQ(one.size(), 2 * 12 + 3);
  EXPECT_EQ(one.head(25).norm(), 0);
  EXPECT_EQ(one[25], -5);
  EXPECT_EQ(one[26], 0);
  EXPECT_EQ(two.norm(), 0); // locked
}



TEST(Preloads, LocksTakeAMotionAway)
{
  for (const bool is_held : {false, true})
    {
      const auto   scene = bolt(is_held);
      ContactModel model(scene->bodies, {1, 2});
      EXPECT_EQ(model.motions.own().cols(), is_held ? 1 : 4);
      // the upper half moves along the axis, and the cut opens as far
      ASSERT_EQ(model.motions.n_free(), is_held ? 0 : 1);
      if (!is_held)
        {
          const auto moved = model.motions.of_free(Eigen::VectorXd::Ones(1));
          const auto way   = model.motions.at(moved, 1, 0);
          EXPECT_NEAR(way[0], 0, 1e-14);
          EXPECT_GT(std::abs(way[1]), .1);
          expect_near(model.motions.at(moved, 2, 0), way);
          EXPECT_NEAR(model.motions.turn(moved, 1).norm(), 0, 1e-14);
        }
      Eigen::VectorXd u = Eigen::VectorXd::Zero(model.coordinates.n_dofs());
      u[25]             = -.02;
      ElasticState state;
      EXPECT_FALSE(model.lock_cuts(.5, u, state));
      EXPECT_TRUE(model.lock_cuts(1, u, state));
      EXPECT_FALSE(model.lock_cuts(1, u, state)); // once
      EXPECT_NEAR(model.opening(model.bodies.cuts[0], u), -.02, 1e-15);
      EXPECT_EQ(model.motions.n_free(), 0);
      const auto placed = model.motions.placement(2);
      EXPECT_NEAR(model.motions.at(placed, 2, 0)[1], -.02, 1e-14);
      if (!is_held)
        {
          EXPECT_NEAR(model.motions.at(placed, 1, 0)[1], -.02, 1e-14);
        }
    }
}
