// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_history.h"
#include "conetact/verification/external_forces.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;
using namespace conetact::verification;

namespace
{
  /** A triangle on a floor, its top held in both directions. */
  struct Held
  {
    std::unique_ptr<application::Scene> scene = test::make_scene(
      test::triangle_on_floor("set Supports = top\n", test::held_top()));
    ContactModel model{scene->bodies, {1}};

    /** Displacements that come of loads, held forces and reactions. */
    ExternalForces
    forces(const Eigen::VectorXd &u,
           const Eigen::VectorXd &loads,
           const Eigen::VectorXd &r) const
    {
      Eigen::VectorXd rest = model.elastic.internal_forces(u) - loads;
      for (const ContactPoint &point : model.points)
        for (unsigned int c = 0; c < 2; ++c)
          rest[2 * point.node->node + c] -= contact::force_of(point, r)[c];
      const contact::DofShare share(model.bodies, model.coordinates);
      return external_forces(
        {model.bodies, model.coordinates, model.points, share},
        rest,
        model.elastic.foundations(u, 1),
        loads,
        r);
    }
  };

  model::Resultant
  sum(const ExternalForces &all)
  {
    model::Resultant result = all.loads;
    for (const auto *list : {&all.contacts, &all.masters, &all.supports})
      for (const model::Resultant &one : *list)
        {
          result.force += one.force;
          result.moment += one.moment;
        }
    return result;
  }
} // namespace



TEST(ExternalForces, BalanceWhereEveryNodeIsInEquilibrium)
{
  const Held            held;
  const Eigen::VectorXd u     = Eigen::VectorXd::LinSpaced(6, .01, -.02);
  Eigen::VectorXd       loads = held.model.elastic.internal_forces(u);
  loads.tail(2)               = Eigen::Vector2d(3, -4);
  // what the elastic forces on the feet leave of these loads the floor takes
  const Eigen::Vector2d r(2, 5);
  loads[1] -= r[0];
  loads[3] -= r[1];
  const ExternalForces all = held.forces(u, loads, r);
  EXPECT_LE(sum(all).force.norm(), 1e-14);
  EXPECT_LE(sum(all).moment.norm(), 1e-14);
  EXPECT_LE(all.bodies[0].error(), 1e-15);
  EXPECT_LE(all.bodies[0].sum.moment.norm(), 1e-14);
  test::expect_near(all.contacts[0].force, test::vector(0, 7));
  test::expect_near(all.contacts[0].moment, test::vector(0, 0, 10));
  // the loads on the top are the support's in the first place
  EXPECT_EQ(all.held.head(4).norm(), 0);
  test::expect_near(all.supports[0].force,
                    test::vector(all.held[4], all.held[5]));
}



// a foot that nothing holds sideways cannot hand its force to the support
TEST(ExternalForces, WhatNothingHoldsStaysUnbalanced)
{
  const Held      held;
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(6);
  loads[0]              = 1;
  const ExternalForces all =
    held.forces(Eigen::VectorXd::Zero(6), loads, Eigen::Vector2d::Zero());
  test::expect_near(sum(all).force, test::vector(1, 0));
  EXPECT_EQ(all.bodies[0].error(), 1);
  EXPECT_EQ(all.bodies[0].forces, 1);
  EXPECT_EQ(all.bodies[0].largest, 1);
}



TEST(ExternalForces, ErrorsAreRelativeToTheMagnitudes)
{
  Balance balance;
  EXPECT_EQ(balance.error(), 0);
  balance.forces    = 100;
  balance.moments   = 10;
  balance.arms      = 200;
  balance.sum.force = test::vector(3, 4);
  EXPECT_EQ(balance.error(), .05);
  balance.sum.moment = test::vector(0, 0, 1);
  EXPECT_EQ(balance.error(), .1);
  // forces that point to the centre turn by rounding only
  balance.moments = 0;
  EXPECT_EQ(balance.turning(), 2);
  EXPECT_EQ(balance.error(), .5);
}



TEST(ExternalForces, SidesOfAJointAreOpposite)
{
  const std::string base =
    test::triangle("base", "1: 0, 0 : 1 ; 2: 2, 0 : 1 ; 3: 1, -1 : 2");
  const auto scene = test::make_scene(
    "set Dimension = 2\nset Bodies = frame, base\nset Contacts = joint\n" +
    test::triangle() + base +
    test::section("Contact joint",
                  "Body = frame|Boundary ids = 1|Master body = base|"
                  "Master boundary ids = 1|Friction coefficient = 0.3|"
                  "Pairing = node to face"));
  const ContactModel    model(scene->bodies, {1});
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(12);
  ASSERT_EQ(model.points.n_unknowns(), 4);
  const Eigen::VectorXd   r = Eigen::Vector4d(1, 2, 3, 4);
  const contact::DofShare share(model.bodies, model.coordinates);
  const ExternalForces    all = external_forces(
    {model.bodies, model.coordinates, model.points, share}, none, {}, none, r);
  EXPECT_NEAR(all.contacts[0].force.norm(), std::hypot(4, 6), 1e-14);
  test::expect_near(all.masters[0].force, -all.contacts[0].force);
  test::expect_near(all.masters[0].moment, -all.contacts[0].moment);
  // each body has these forces alone
  for (const std::size_t b : {0u, 1u})
    EXPECT_NEAR(all.bodies[b].sum.force.norm(), std::hypot(4, 6), 1e-14);
}



TEST(ExternalForces, FoundationsBelongToTheirSupport)
{
  const auto              scene = test::make_scene(test::triangle_on_floor(
    "set Supports = top\n",
    test::section("Support top",
                  "Body = frame|Boundary ids = 2|Directions = x, y|"
                               "Displacement = 0.1; 0|Stiffness = 50")));
  const ContactModel      model(scene->bodies, {1});
  const Eigen::VectorXd   u    = Eigen::VectorXd::Zero(6);
  const Eigen::VectorXd   none = u;
  const contact::DofShare share(model.bodies, model.coordinates);
  const ExternalForces    all =
    external_forces({model.bodies, model.coordinates, model.points, share},
                    none,
                    model.elastic.foundations(u, 1),
                    none,
                    Eigen::Vector2d::Zero());
  EXPECT_GT(all.supports[0].force[0], 0); // towards where its ground has gone
  EXPECT_EQ(all.supports[0].force[1], 0);
  EXPECT_EQ(all.held.norm(), 0);
  // about the origin, of a force at (1, 1)
  EXPECT_NEAR(all.supports[0].moment[2], -all.supports[0].force[0], 1e-14);
}
