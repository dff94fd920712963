// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/equal_bodies.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::contact;

namespace
{
  /** Groups among triangles that stand on a floor by themselves. */
  std::vector<std::vector<unsigned int>>
  groups(const std::vector<std::string> &bodies)
  {
    std::string names, contacts, text;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      {
        const std::string name = "b" + std::to_string(i);
        names += (i > 0 ? ", " : "") + name;
        text += test::triangle(name, bodies[i]) +
                test::section("Contact " + name,
                              "Body = " + name +
                                "|Boundary ids = 1|Obstacle = floor|"
                                "Friction coefficient = 0.2");
      }
    const auto scene = test::make_scene(
      "set Dimension = 2\nset Bodies = " + names +
      "\nset Obstacles = floor\nset Contacts = " + names + "\n" + text +
      test::section("Obstacle floor", "Shape = half space|Normal = 0, 1"));
    const NodeRules       rules(scene->bodies, {1});
    const Coordinates     coordinates(scene->bodies, rules);
    const ElasticSystem   elastic(scene->bodies);
    const BodyCoordinates own(scene->bodies, coordinates);
    EXPECT_EQ(may_have_equals(scene->bodies), bodies.size() > 1);
    return find_equal_bodies(elastic, own);
  }

  using Groups = std::vector<std::vector<unsigned int>>;

  const std::string upright = "1: 0, 0 : 1 ; 2: 2, 0 : 1 ; 3: 1, 1.5 : 2";
  const std::string moved   = "1: 7, 0 : 1 ; 2: 9, 0 : 1 ; 3: 8, 1.5 : 2";
  const std::string turned  = "1: 20, 0 : 1 ; 2: 20, 2 : 1 ; 3: 18.5, 1 : 2";
  const std::string higher  = "1: 30, 0 : 1 ; 2: 32, 0 : 1 ; 3: 31, 1.6 : 2";
} // namespace



TEST(EqualBodies, AreCopiesThatAreMoved)
{
  EXPECT_EQ(groups({upright, moved}), (Groups{{0, 1}}));
  EXPECT_EQ(groups({upright, turned, moved}), (Groups{{0, 2}}));
}



TEST(EqualBodies, OthersAreLeftOut)
{
  EXPECT_EQ(groups({upright, higher}), Groups());
  EXPECT_EQ(groups({higher, upright, moved}), (Groups{{1, 2}}));
  EXPECT_EQ(groups({upright}), Groups());
}
