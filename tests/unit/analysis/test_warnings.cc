// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/warnings.h"

#include <utility>

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::analysis;
using namespace conetact::application;
using namespace conetact::contact;
using namespace conetact::solvers;

namespace
{
  /** A triangle on the floor, with what is warned of it. */
  struct Warned
  {
    explicit Warned(const std::string &friction)
      : scene(test::make_scene(test::triangle_on_floor("", "", friction)))
      , model(scene->bodies, {1})
      , log(true, false)
      , warnings(model, log)
    {}

    /** The lines so far. */
    std::string
    lines()
    {
      if (!std::exchange(is_open, true))
        log.open(test::folder());
      return test::read_file(test::folder() / "log.txt");
    }

    std::unique_ptr<Scene> scene;
    ContactModel           model;
    Log                    log;
    Warnings               warnings;
    bool                   is_open = false;
  };

  using States             = std::vector<NodeState>;
  constexpr NodeState open = NodeState::open, stick = NodeState::stick,
                      slip = NodeState::slip;
} // namespace



TEST(Warnings, EachIsSaidOnce)
{
  Warned warned("");
  warned.warnings.once("a", "One.");
  warned.warnings.once("b", "Two.");
  warned.warnings.once("a", "Three.");
  EXPECT_EQ(warned.lines(), "warning: One.\nwarning: Two.\n");
}



TEST(Warnings, AFloatingBodyIsDeterminateWhereFrictionHoldsIt)
{
  Warned      warned("|Friction coefficient = 0.3");
  const auto &points         = warned.model.points;
  const auto  is_determinate = [&](const States &states) {
    ContactState state{Eigen::VectorXd::Zero(points.n_unknowns()),
                       Eigen::VectorXd::Zero(points.n_unknowns()),
                       states};
    for (std::size_t i = 0; i < 2; ++i)
      if (states[i] != open)
        {
          state.r[points[i].normal()] = 1;
          state.r[points[i].first]    = states[i] == slip ? -.3 : .1;
        }
      else
        state.v[points[i].normal()] = .1;
    return warned.warnings.is_determinate(state, 1, nullptr);
  };
  EXPECT_TRUE(is_determinate({stick, stick}));
  EXPECT_TRUE(is_determinate({stick, slip}));
  EXPECT_FALSE(is_determinate({slip, slip}));
  // one way or the other
  EXPECT_NE(warned.lines().find("1, 0, 0), which nothing opposes: forces are "
                                "determined, its position is not"),
            std::string::npos)
    << warned.lines();
  EXPECT_FALSE(is_determinate({stick, open}));
  EXPECT_FALSE(is_determinate({open, open}));
}



TEST(Warnings, RotationsAndStrainsThatAreLarge)
{
  Warned                warned("|Friction coefficient = 0.3");
  const Eigen::VectorXd none    = Eigen::VectorXd::Zero(6);
  const RigidMotions   &motions = warned.model.motions;
  Eigen::VectorXd       turn    = none.head(3);
  // the mode that turns the frame, by one radian
  for (Eigen::Index k = 0; k < 3; ++k)
    if (const double angle = motions.rotation(Eigen::Vector3d::Unit(k), 0);
        angle > 0)
      turn[k] = 1 / angle;
  ASSERT_NEAR(motions.rotation(turn, 0), 1, 1e-14);
  warned.warnings.check_size(.049 * turn, none);
  EXPECT_EQ(warned.lines(), "");
  warned.warnings.check_size(.051 * turn, none);
  EXPECT_NE(warned.lines().find("body 'frame' turns by 0.051 rad."),
            std::string::npos);
  Eigen::VectorXd stretched = none;
  stretched[2]              = .22; // of the base, 2 long
  warned.warnings.check_size(none.head(3), stretched);
  EXPECT_NE(warned.lines().find("body 'frame' is strained by about 0.1"),
            std::string::npos);
}
