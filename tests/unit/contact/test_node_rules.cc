// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/node_rules.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;
using test::expect_near;
using test::vector;

namespace
{
  const double half = std::sqrt(.5);

  std::string
  support(const std::string &name,
          const std::string &directions,
          const std::string &displacement)
  {
    return test::section("Support " + name,
                         "Body = frame|Boundary ids = 2|Directions = " +
                           directions + "|Displacement = " + displacement);
  }
} // namespace



TEST(NodeRules, ABasisIsCompletedByAxesFirst)
{
  const auto rest = complement({vector(0, 1)}, 2);
  ASSERT_EQ(rest.size(), 1);
  expect_near(rest[0], vector(1, 0));
  EXPECT_EQ(complement({}, 3).size(), 3);
  const auto oblique = complement({vector(half, half)}, 2);
  ASSERT_EQ(oblique.size(), 1);
  EXPECT_NEAR(oblique[0] * vector(half, half), 0, 1e-15);
  EXPECT_NEAR(oblique[0].norm(), 1, 1e-15);
}



TEST(NodeRules, WithinASpanAndAcrossIt)
{
  const std::vector<Tensor<1, 3>> plane = {vector(1, 0, 0), vector(0, 0, 1)};
  EXPECT_TRUE(is_spanned(vector(half, 0, half), plane));
  EXPECT_FALSE(is_spanned(vector(half, half, 0), plane));
  EXPECT_TRUE(is_across(vector(0, 1, 0), plane));
  EXPECT_FALSE(is_across(vector(half, half, 0), plane));
}



TEST(NodeRules, ARollerLeavesWhatIsAcross)
{
  const auto scene = test::make_scene(
    test::triangle_on_floor("set Supports = top\n",
                            support("top", "(1, 1)", "0.1*t")));
  const NodeRules rules(scene->bodies, {1, 2});
  EXPECT_EQ(rules.find(0, 0), nullptr);
  const NodeRule *rule = rules.find(0, 2);
  ASSERT_NE(rule, nullptr);
  ASSERT_EQ(rule->held.size(), 1);
  expect_near(rule->held[0].direction, vector(half, half));
  ASSERT_EQ(rule->free.size(), 1);
  EXPECT_NEAR(std::abs(rule->free[0] * vector(half, -half)), 1, 1e-15);
  EXPECT_NEAR(rules.displacement(rule->held[0], Point<3>(1, 1, 0), 2),
              .2,
              1e-15);
}



// u_x = a and (u_x + u_y)/sqrt 2 = b: u_y = sqrt 2 b - a
TEST(NodeRules, SupportsThatAreNotOrthogonal)
{
  const auto scene = test::make_scene(
    test::triangle_on_floor("set Supports = across, askew\n",
                            support("across", "x", "0.3") +
                              support("askew", "(1, 1)", "0.5*t")));
  const NodeRules rules(scene->bodies, {1});
  const NodeRule *rule = rules.find(0, 2);
  ASSERT_NE(rule, nullptr);
  ASSERT_EQ(rule->held.size(), 2);
  EXPECT_TRUE(rule->free.empty());
  Tensor<1, 3> u;
  for (const HeldDirection &held : rule->held)
    u += rules.displacement(held, Point<3>(1, 1, 0), 2) * held.direction;
  expect_near(u, vector(.3, std::sqrt(2.) - .3));
}



TEST(NodeRules, SupportsMayAgreeButNotContradict)
{
  const auto rules_of = [](const std::string &other) {
    const auto scene = test::make_scene(
      test::triangle_on_floor("set Supports = one, other\n",
                              support("one", "x, y", "0.1*t ; 0.2*t") +
                                support("other", "(1, 1)", other)));
    return NodeRules(scene->bodies, {1, 2}).rules().size();
  };
  EXPECT_EQ(rules_of("0.3*t/sqrt(2)"), 1);
  EXPECT_THROW(rules_of("0.3*t^2/sqrt(2)"), InputError);
}
