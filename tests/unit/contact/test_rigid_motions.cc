// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/coordinates.h"
#include "conetact/contact/rigid_motions.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::application;
using namespace conetact::bodies;
using namespace conetact::contact;
using namespace conetact::solvers;
using test::expect_near;
using test::vector;

namespace
{
  /** A scene with the rooms that rigid motions stand on. */
  struct Motions
  {
    explicit Motions(const std::string &text)
      : scene(test::make_scene(text))
      , rules(scene->bodies, {1, 2})
      , points(scene->bodies, rules, {1, 2})
      , coordinates(scene->bodies, rules)
      , motions(scene->bodies, rules, points)
    {}

    std::unique_ptr<Scene> scene;
    NodeRules              rules;
    ContactPoints          points;
    Coordinates            coordinates;
    RigidMotions           motions;
  };

  const std::string rough = "|Friction coefficient = 0.2";
} // namespace



TEST(RigidMotions, FoundationsSeeSomeAndNothingOfTheOthers)
{
  // springs along one oblique direction leave what is across it
  const double        c = .6, s = .8;
  const Motions       all(test::triangle_on_floor(
    "set Supports = springs\n",
    test::section("Support springs",
                  "Body = frame|Boundary ids = 2|Stiffness = 10|"
                        "Directions = (0.6, 0.8)"),
    rough));
  const RigidMotions &motions = all.motions;
  ASSERT_EQ(motions.n_free(), 3);
  ASSERT_EQ(motions.loose().size(), 2u);
  EXPECT_EQ(motions.unresisted().cols(), 2);
  const auto &springs = all.scene->bodies.supports[0];
  for (const Eigen::Index k : motions.loose())
    {
      const Eigen::VectorXd u =
        motions.field(motions.of_free(Eigen::Vector3d::Unit(k)));
      for (const SurfaceNode &node : springs.surface.nodes)
        EXPECT_NEAR(all.coordinates.at_node(u, 0, node.node) * vector(c, s),
                    0,
                    1e-15);
    }
}



TEST(RigidMotions, AFloatingBodyHasAllOfThem)
{
  const Motions       all(test::triangle_on_floor("", "", rough));
  const RigidMotions &motions = all.motions;
  ASSERT_EQ(motions.n_free(), 3);
  EXPECT_EQ(motions.body_of_free(), (std::vector<unsigned int>{0, 0, 0}));
  EXPECT_EQ(motions.unresisted().cols(), 3);
  EXPECT_EQ(motions.unseen().cols(), 0); // two feet with friction see them all
  EXPECT_EQ(motions.placement(2).norm(), 0);
  // none of them strains a bar
  const Structure &body = *all.scene->bodies.structures[0];
  for (Eigen::Index k = 0; k < 3; ++k)
    {
      const Eigen::VectorXd u =
        motions.field(motions.of_free(Eigen::Vector3d::Unit(k)));
      EXPECT_GT(u.norm(), .1);
      EXPECT_LE((test::stiffness(body) * u).norm(), 1e-12);
    }
}



TEST(RigidMotions, ResultantsAreTheAdjointOfTheField)
{
  const Motions         all(test::triangle_on_floor("", "", rough));
  const Eigen::Vector3d amounts(.3, -.7, .2);
  Eigen::VectorXd       f(6);
  f << 1, -2, 3, 5, -8, 13;
  const Eigen::VectorXd u = all.motions.field(amounts);
  EXPECT_NEAR(f.dot(u), all.motions.resultants(f).dot(amounts), 1e-13);
  for (unsigned int i = 0; i < 3; ++i)
    expect_near(all.motions.at(amounts, 0, i), vector(u[2 * i], u[2 * i + 1]));
}



TEST(RigidMotions, AHingeLeavesTheRotationAboutIt)
{
  const Motions all(test::triangle_on_floor("set Supports = top\n",
                                            test::held_top("0.1*t ; -0.2*t"),
                                            rough));
  ASSERT_EQ(all.motions.n_free(), 1);
  const auto   free  = all.motions.of_free(Eigen::VectorXd::Ones(1));
  const double moved = all.motions.at(free, 0, 0).norm();
  expect_near(all.motions.at(free, 0, 2), Tensor<1, 3>());
  EXPECT_GT(moved, .1);
  // a foot moves across its way to the hinge, at a distance of sqrt 2
  EXPECT_NEAR(all.motions.at(free, 0, 0) * vector(1, 1), 0, 1e-14);
  EXPECT_NEAR(all.motions.rotation(free, 0), moved / std::sqrt(2.), 1e-14);
  // what supports prescribe is the placement
  expect_near(all.motions.at(all.motions.placement(2), 0, 2), vector(.2, -.4));
}



TEST(RigidMotions, SlidingOnASmoothFloorIsNotSeen)
{
  const Motions         all(test::triangle_on_floor("", ""));
  const Eigen::MatrixXd unseen = all.motions.unseen();
  ASSERT_EQ(unseen.cols(), 1);
  const RigidMotions::Motion motion =
    all.motions.largest(all.motions.of_free(unseen.col(0)));
  EXPECT_EQ(motion.body, 0);
  EXPECT_EQ(describe(motion), "along (1, 0, 0)");
}



TEST(RigidMotions, BodiesThatNothingHoldsAreRefused)
{
  EXPECT_THROW(Motions("set Dimension = 2\nset Bodies = frame\n" +
                       test::triangle()),
               InputError);
}
