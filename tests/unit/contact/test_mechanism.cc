// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/mechanism.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

namespace
{
  using Nodes = std::vector<std::size_t>;

  /** A triangle that stands on two feet, unknowns (t, n) each. */
  class Standing : public testing::Test
  {
  protected:
    std::unique_ptr<application::Scene> scene = test::make_scene(
      test::triangle_on_floor("", "", "|Friction coefficient = 0.3"));
    ContactModel model{scene->bodies, {1}};

    Mechanism
    mechanism(const Eigen::Vector4d   &velocity,
              const std::vector<bool> &touching = {true, true}) const
    {
      return name_mechanism(model, velocity, touching);
    }
  };
} // namespace



TEST_F(Standing, BothFeetMoveByOneTranslation)
{
  const Mechanism found = mechanism({1, 0, 1, 0});
  EXPECT_EQ(found.kind, "sliding");
  EXPECT_EQ(found.slide, (Nodes{0, 1}));
  EXPECT_TRUE(found.stay.empty());
  EXPECT_TRUE(found.open.empty());
}



TEST_F(Standing, OneFootStaysAndTheOtherOpens)
{
  const Mechanism found = mechanism({0, 0, .2, 1});
  EXPECT_EQ(found.kind, "tipping");
  EXPECT_EQ(found.stay, Nodes{0});
  EXPECT_EQ(found.open, Nodes{1});
  // the foot that stays on the floor may slide
  EXPECT_EQ(mechanism({1, 0, .2, 1}).kind, "tipping");
}



TEST_F(Standing, BothFeetOpen)
{
  const Mechanism found = mechanism({0, 1, 0, 1});
  EXPECT_EQ(found.kind, "lifting");
  EXPECT_EQ(found.open, (Nodes{0, 1}));
}



TEST_F(Standing, FeetThatSlideApartTurnOrDeform)
{
  EXPECT_EQ(mechanism({1, 0, -1, 0}).kind, "turning");
  EXPECT_EQ(mechanism({1, 0, 0, 0}).kind, "turning");
}



// a foot in the air takes no part, but that it goes up tells tipping
TEST_F(Standing, OpenFeetAreNotCounted)
{
  const Mechanism found = mechanism({1, 0, 1, 0}, {true, false});
  EXPECT_EQ(found.kind, "sliding");
  EXPECT_EQ(found.slide, Nodes{0});
  EXPECT_EQ(mechanism({1, 0, 1, .5}, {true, false}).kind, "tipping");
}



TEST_F(Standing, ByVelocitiesFarBelowTheLargestNothingMoves)
{
  const Mechanism found = mechanism({1e-7, 1e-7, 0, 1});
  EXPECT_EQ(found.stay, Nodes{0});
  EXPECT_EQ(found.open, Nodes{1});
}



TEST_F(Standing, NamesOfNodes)
{
  EXPECT_EQ(name_nodes(model, {"feet"}, {1}), "node 1 of contact 'feet'");
  EXPECT_EQ(name_nodes(model, {"feet"}, {0, 1}),
            "nodes 0, 1 of contact 'feet'");
  EXPECT_EQ(name_nodes(model, {"feet"}, Nodes(10, 1)),
            "nodes 1, 1, 1, 1, 1, 1, 1, 1 and 2 more of contact 'feet'");
  EXPECT_EQ(name_nodes(model, {"feet"}, {}), "");
}
