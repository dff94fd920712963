// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What a scene means for a load path.

#include "conetact/application/method_checks.h"
#include "conetact/contact/preloads.h"

#include "scene_fixture.h"
#include "sentence.h"

using namespace conetact;

namespace
{
  std::string
  pushed(const std::string &value, const std::string &times)
  {
    return test::triangle_on_floor("set Loads = push\n",
                                   test::section("Load push",
                                                 "Body = frame|Kind = nodal "
                                                 "force|Boundary ids = 2|"
                                                 "Value = " +
                                                   value) +
                                     test::section("Time", "Times = " + times),
                                   "|Friction coefficient = 0.2");
  }

  std::string
  sentence_of_stages(const application::Scene &scene)
  {
    return test::sentence_of(
      [&] { application::check_linear_stages(scene, scene.times); });
  }

  std::string
  stages(const std::string &value, const std::string &times)
  {
    const auto scene = test::make_scene(pushed(value, times));
    return sentence_of_stages(*scene);
  }
} // namespace



TEST(ScenePath, LoadsAreLinearBetweenTheirBends)
{
  EXPECT_EQ(stages("3*t ; -1", "1, 2"), "accepted");
  EXPECT_EQ(stages("max(t - 0.5, 0) ; -1", "0.5, 2"), "accepted");
  EXPECT_TRUE(test::starts(stages("max(t - 0.5, 0) ; -1", "1, 2"),
                           "Load 'push', Value: it is not linear in t between "
                           "t = 0 and t = 1."));
  EXPECT_NE(stages("0 ; t^2", "1").find("not linear"), std::string::npos);
}



TEST(ScenePath, SupportsThatMove)
{
  const auto scene =
    test::make_scene(test::triangle_on_floor("set Supports = top\n",
                                             test::held_top("0.1*t^2 ; 0")));
  EXPECT_TRUE(test::starts(sentence_of_stages(*scene),
                           "Support 'top', Displacement: it is not linear"));
}



// 2 presses each foot against the floor, along -n
TEST(ScenePath, APrestressPressesTheNodesOfItsContact)
{
  const auto            scene = test::make_scene(test::triangle_on_floor(
    "set Supports = top\n", test::held_top(), "|Prestress = 2 + x"));
  const Eigen::VectorXd f     = contact::prestress_forces(scene->bodies);
  Eigen::VectorXd       expected(6);
  expected << 0, -2, 0, -4, 0, 0;
  EXPECT_LE((f - expected).norm(), 1e-15);
}
