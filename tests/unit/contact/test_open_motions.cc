// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/open_motions.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::application;
using namespace conetact::contact;
using namespace conetact::solvers;

namespace
{
  constexpr double  limit = .2;
  const std::string rough = "|Friction coefficient = 0.2";

  /** A triangle of bars on a floor: its two feet are candidates. */
  struct Feet
  {
    explicit Feet(const std::string &friction)
      : scene(test::make_scene(test::triangle_on_floor("", "", friction)))
      , rules(scene->bodies, {1})
      , points(scene->bodies, rules, {1})
      , motions(scene->bodies, rules, points)
      , state{Eigen::VectorXd::Zero(points.n_unknowns()),
              Eigen::VectorXd::Zero(points.n_unknowns()),
              std::vector<NodeState>(points.size(), NodeState::open)}
    {}

    /** A foot, with friction along its tangent, after a slip along it. */
    void
    press(const Eigen::Index foot,
          const double       friction = 0,
          const double       slip     = 0)
    {
      state.r[points[foot].normal()] = 1;
      state.node[static_cast<std::size_t>(foot)] =
        friction == 0 || std::abs(friction) == limit ? NodeState::slip :
                                                       NodeState::stick;
      if (friction != 0)
        {
          state.r[points[foot].first] = friction;
          state.v[points[foot].first] = slip;
        }
    }

    OpenMotions
    open() const
    {
      return {motions, points, state, 1.};
    }

    /** A way of such amounts, and what is left of it, along all modes. */
    Eigen::VectorXd
    shortened(const Eigen::Vector3d &amounts) const
    {
      const Eigen::VectorXd more = open().shortening(motions.field(amounts));
      return more.size() == 0 ?
               Eigen::VectorXd(amounts) :
               Eigen::VectorXd(amounts + motions.of_free(more));
    }

    std::unique_ptr<Scene> scene;
    NodeRules              rules;
    ContactPoints          points;
    RigidMotions           motions;
    ContactState           state;
  };

} // namespace



TEST(OpenMotions, WhatNothingPressesStaysWhereItIs)
{
  Feet high(rough);
  for (Eigen::Index i = 0; i < 2; ++i)
    high.state.v[high.points[i].normal()] = 10;
  EXPECT_TRUE(high.open().exist());
  EXPECT_GT(high.open().elsewhere().norm(), .1);
  EXPECT_LE(high.shortened({.3, .2, -.1}).norm(), 1e-13);
}



TEST(OpenMotions, NothingIsShortenedThroughAFloor)
{
  const Feet feet(rough); // both touch, at the end of a way up
  EXPECT_LE((feet.shortened({.3, .2, 0}) - Eigen::Vector3d(0, .2, 0)).norm(),
            1e-13);
}



TEST(OpenMotions, WhatIsPressedWithoutFrictionSlidesBack)
{
  Feet feet("");
  feet.press(0);
  feet.press(1);
  EXPECT_LE(
    (feet.shortened({.3, .2, -.1}) - Eigen::Vector3d(0, .2, -.1)).norm(),
    1e-13);
}



TEST(OpenMotions, FrictionBelowItsLimitHoldsWhatIsPressed)
{
  Feet feet(rough);
  feet.press(0, .1);
  feet.press(1, -.2, .3);
  EXPECT_FALSE(feet.open().exist());
  EXPECT_EQ(feet.open().elsewhere().size(), 0);
}



// the tangent of a floor in the plane is x
TEST(OpenMotions, SlipsKeepTheirDirections)
{
  Feet feet(rough);
  feet.press(0, -.2, .1);
  feet.press(1, -.2, .3);
  EXPECT_GT(feet.open().elsewhere().norm(), .1);
  EXPECT_LE((feet.shortened({.3, 0, 0}) - Eigen::Vector3d(.2, 0, 0)).norm(),
            1e-13);
  // apart, both just at the limit: neither way is open
  Feet apart(rough);
  apart.press(0, .2);
  apart.press(1, -.2);
  EXPECT_TRUE(apart.open().exist());
  EXPECT_EQ(apart.open().elsewhere().size(), 0);
}
