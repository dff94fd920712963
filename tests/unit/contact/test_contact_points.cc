// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_points.h"
#include "conetact/contact/increment_laws.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;
using test::expect_near;
using test::vector;

TEST(ContactPoints, TangentsFirstTheNormalLast)
{
  const auto scene = test::make_scene(
    test::triangle_on_floor("set Supports = top\n",
                            test::held_top(),
                            "|Friction coefficient = 0.1 + 0.1*x"));
  const NodeRules     rules(scene->bodies, {1});
  const ContactPoints points(scene->bodies, rules, {1});
  ASSERT_EQ(points.size(), 2);
  EXPECT_EQ(points.layout().first, (std::vector<Eigen::Index>{0, 2, 4}));
  EXPECT_NEAR(points.layout().mu[1], .3, 1e-15);
  EXPECT_FALSE(points.traits().shares_nodes);
  EXPECT_FALSE(points.traits().has_prescribed_slip);
  for (const ContactPoint &point : points)
    {
      ASSERT_EQ(point.directions.size(), 2);
      expect_near(point.directions[0], vector(1, 0)); // t1 = (n_y, -n_x)
      expect_near(point.directions[1], vector(0, 1));
      expect_near(point.dual[1], vector(0, 1));
    }
}



TEST(ContactPoints, WithoutFrictionTheNormalIsAll)
{
  const auto scene = test::make_scene(
    test::triangle_on_floor("set Supports = top\n", test::held_top()));
  const NodeRules     rules(scene->bodies, {1});
  const ContactPoints points(scene->bodies, rules, {1});
  EXPECT_EQ(points.layout().first, (std::vector<Eigen::Index>{0, 1, 2}));
  ASSERT_EQ(points[std::size_t(0)].frictionless.size(), 1);
  expect_near(points[std::size_t(0)].frictionless[0], vector(1, 0));
}



TEST(ContactPoints, AHeldNormalHasNoPoint)
{
  const std::string roller =
    "Body = frame|Boundary ids = 1|Directions = y|Displacement = 0";
  const auto scene = test::make_scene(
    "set Dimension = 2\nset Bodies = frame\nset Obstacles = floor, wall\n"
    "set Contacts = feet, side\nset Supports = roller\n" +
    test::triangle() +
    test::section("Obstacle floor", "Shape = half space|Normal = 0, 1") +
    test::section("Obstacle wall", "Shape = half space|Normal = 1, 0") +
    test::section("Contact feet",
                  "Body = frame|Boundary ids = 1|Obstacle = floor") +
    test::section("Contact side",
                  "Body = frame|Boundary ids = 1|Obstacle = wall|"
                  "Friction coefficient = 0.2") +
    test::section("Support roller", roller));
  const NodeRules     rules(scene->bodies, {1});
  const ContactPoints points(scene->bodies, rules, {1});
  EXPECT_EQ(points.traits().n_held, 2); // of the floor
  ASSERT_EQ(points.size(), 2);          // of the wall
  // and the roller holds their tangent: the normal is left
  EXPECT_EQ(points.layout().first, (std::vector<Eigen::Index>{0, 1, 2}));
  expect_near(points[std::size_t(0)].directions[0], vector(1, 0));
}



TEST(ContactPoints, ComponentsAreRelativeToWhatMoves)
{
  const auto scene = test::make_scene(
    "set Dimension = 2\nset Bodies = frame\nset Obstacles = floor\n"
    "set Contacts = feet\nset Supports = top\n" +
    test::triangle() +
    test::section("Obstacle floor",
                  "Shape = half space|Normal = 0, 1|"
                  "Displacement = 0.1*t ; -0.2*t") +
    test::section("Contact feet",
                  "Body = frame|Boundary ids = 1|Obstacle = floor|"
                  "Friction coefficient = 0.2") +
    test::held_top());
  const NodeRules     rules(scene->bodies, {1});
  const ContactPoints points(scene->bodies, rules, {1});
  const auto          at = [](const unsigned int, const unsigned int node) {
    return node == 0 ? vector(1, 2) : vector(0, 0);
  };
  const Eigen::VectorXd v = points.components(at, 2);
  EXPECT_LE((v - Eigen::Vector4d(1 - .2, 2 + .4, -.2, .4)).norm(), 1e-15);
}



// |(F_1/mu_1, F_2/mu_2)| = F_n is a circular cone in the scaled unknowns
TEST(ContactPoints, AnEllipticConeBecomesACircularOne)
{
  const auto scene = test::make_scene(
    "set Dimension = 3\nset Bodies = frame\nset Obstacles = floor\n"
    "set Contacts = feet\nset Supports = top\nsubsection Body frame\n"
    "set Kind = frame\nset Sections = bar\n" +
    test::section("Frame",
                  "Nodes = 1: 0, 0, 0 : 1 ; 2: 2, 0, 0 : 1 ; 3: 0, 2, 0 : 1 ; "
                  "4: 1, 1, 1 : 2|Members = 1-2-3-1-4: bar ; 2-4-3: bar") +
    test::section("Section bar", "Young modulus = 1000|Area = 0.1") + "end\n" +
    test::section("Obstacle floor", "Shape = half space|Normal = 0, 0, 1") +
    test::section("Contact feet",
                  "Body = frame|Boundary ids = 1|Obstacle = floor|"
                  "Friction coefficient = 0.4|Second friction coefficient = "
                  "0.1|Friction angle = 30") +
    test::section("Support top",
                  "Body = frame|Boundary ids = 2|Directions = x, y, z"));
  const NodeRules     rules(scene->bodies, {1});
  const ContactPoints points(scene->bodies, rules, {1});
  const ContactPoint &point = points[std::size_t(0)];
  ASSERT_EQ(point.directions.size(), 3);
  for (const Tensor<1, 3> &friction :
       {.4 * point.node->axis_1, .1 * point.node->axis_2})
    {
      const Tensor<1, 3> force = point.node->n + friction;
      const double       r_1   = force * point.directions[0],
                   r_2         = force * point.directions[1],
                   r_n         = force * point.directions[2];
      EXPECT_NEAR(std::hypot(r_1, r_2), point.mu * r_n, 1e-15);
    }
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int k = 0; k < 3; ++k)
      EXPECT_NEAR(point.dual[i] * point.directions[k], i == k, 1e-15);
}



/** What Newton's method is told against differences of the limits themselves,
 * of friction that goes with p and v, and with a bond that softens. */
TEST(IncrementLaws, SlopesAreDerivatives)
{
  for (const std::string &law :
       {std::string("0.3/(1 + p/5)"),
        std::string("0.15 + 0.1*exp(-v/0.02)"),
        std::string("(0.2 + 0.1/(1 + p))*(1 + v)"),
        std::string("0.1 + 0.01*p|Cohesion = 2|Tensile strength = 1|"
                    "Cohesion lost = slip|Softening length = 0.3")})
    {
      const auto scene = test::make_scene(
        "set Dimension = 2\nset Bodies = block\nset Obstacles = floor\n"
        "set Contacts = bottom\nset Supports = top\n"
        "subsection Body block\n" +
        test::section("Mesh",
                      "Generator = subdivided_hyper_rectangle|"
                      "Arguments = 2, 1 : 0, 0 : 2, 1 : true") +
        test::section("Material", "Young modulus = 1000|Poisson ratio = 0.3") +
        "end\n" +
        test::section("Obstacle floor", "Shape = half space|Normal = 0, 1") +
        test::section("Contact bottom",
                      "Body = block|Boundary ids = 2|Obstacle = floor|"
                      "Friction coefficient = " +
                        law) +
        test::section("Support top",
                      "Body = block|Boundary ids = 3|Directions = x, y"));
      const NodeRules                 rules(scene->bodies, {1});
      const ContactPoints             points(scene->bodies, rules, {1});
      std::vector<pairing::Situation> known(points.size());
      const IncrementLaws             laws(points,
                               known,
                               Eigen::VectorXd::Zero(points.n_unknowns()),
                               .5);
      const auto value = [&](const double s, const double u, const double g) {
        return laws.limit(0, s, u, g).value;
      };
      for (const double s : {.5, 2.})
        for (const double u : {.01, .05})
          {
            const double                 h = 1e-6, g = .02;
            const solvers::FrictionLimit limit = laws.limit(0, s, u, g);
            EXPECT_NEAR(limit.by_force,
                        (value(s + h, u, g) - value(s - h, u, g)) / (2 * h),
                        1e-6);
            EXPECT_NEAR(limit.by_slip,
                        (value(s, u + h, g) - value(s, u - h, g)) / (2 * h),
                        1e-5);
            EXPECT_NEAR(limit.by_gap,
                        (value(s, u, g + h) - value(s, u, g - h)) / (2 * h),
                        1e-5);
          }
    }
}
