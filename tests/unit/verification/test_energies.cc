// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_history.h"
#include "conetact/verification/energies.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;
using namespace conetact::verification;

namespace
{
  /** A triangle and its energies, increment by increment. */
  class Story
  {
  public:
    explicit Story(const std::string &support,
                   const std::string &floor    = "",
                   const std::string &friction = "|Friction coefficient = 0.5")
      : scene(test::make_scene(
          "set Dimension = 2\nset Bodies = frame\nset Obstacles = floor\n"
          "set Contacts = feet\nset Supports = top\n" +
          test::triangle() +
          test::section("Obstacle floor",
                        "Shape = half space|Normal = 0, 1" + floor) +
          test::section("Contact feet",
                        "Body = frame|Boundary ids = 1|Obstacle = floor" +
                          friction) +
          test::section("Support top",
                        "Body = frame|Boundary ids = 2|Directions = x, y|" +
                          support)))
      , model(scene->bodies, {1, 2, 3})
    {}

    /**
     * The next increment ends at t with displacements u (the top's are those
     * of its support) and reactions r; loads are what balances them.
     */
    model::IncrementRecord
    next(const double t, Eigen::VectorXd u, const Eigen::VectorXd &r)
    {
      for (Eigen::Index i = 0; i < 6; ++i)
        if (model.coordinates.prescribed(t)[i] != 0)
          u[i] = model.coordinates.prescribed(t)[i];
      const Eigen::VectorXd internal = model.elastic.structure_forces(u);
      Finding               finding;
      finding.u             = contact::shared(u);
      finding.strain_energy = .5 * u.dot(internal);
      finding.foundations   = model.elastic.foundations(u, t);
      finding.displacements = model.relative_displacements(u, t);
      finding.change        = finding.displacements;
      if (before.size() > 0)
        finding.change -= before;
      finding.change_as_before = finding.change;
      before                   = finding.displacements;
      const Eigen::VectorXd all =
        internal - reactions(r) - foundations(finding);
      Eigen::VectorXd loads = all;
      finding.external.held = Eigen::VectorXd::Zero(6);
      if (finding.foundations[0].forces.size() == 0)
        {
          loads.tail(2).setZero();
          finding.external.held.tail(2) = all.tail(2);
        }
      model::IncrementRecord record;
      finding.acting = loads + finding.external.held;
      energies.add({model.bodies, model.coordinates},
                   model.points,
                   r,
                   t,
                   last_u,
                   finding,
                   record);
      last_u = finding.u;
      return record;
    }

    Eigen::Index
    n() const
    {
      return model.points.n_unknowns();
    }

    std::unique_ptr<application::Scene> scene;
    ContactModel                        model;

  private:
    Eigen::VectorXd
    reactions(const Eigen::VectorXd &r) const
    {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(6);
      for (const ContactPoint &point : model.points)
        for (unsigned int c = 0; c < 2; ++c)
          f[2 * point.node->node + c] = contact::force_of(point, r)[c];
      return f;
    }
    static Eigen::VectorXd
    foundations(const Finding &finding)
    {
      const Eigen::VectorXd &f = finding.foundations[0].forces;
      return f.size() > 0 ? f : Eigen::VectorXd(Eigen::VectorXd::Zero(6));
    }

    Energies              energies;
    contact::SharedVector last_u;
    Eigen::VectorXd       before; ///< relative displacements
  };

  /** Displacements and reactions of any kind. */
  Eigen::VectorXd
  some(const Eigen::Index n, const double first, const double last)
  {
    return Eigen::VectorXd::LinSpaced(n, first, last);
  }

  /** What comes in stays as strain or is lost. */
  void
  expect_first_law(Story &story)
  {
    double stored = 0;
    for (const double t : {1., 2., 3.})
      {
        const auto record = story.next(t,
                                       some(6, .01 * t * t, -.02 * t),
                                       some(story.n(), 2 - t, 3 * t));
        EXPECT_NEAR(record.external_work,
                    record.strain_energy - stored + record.dissipation +
                      record.contact_work_normal,
                    1e-13)
          << t;
        EXPECT_NE(record.external_work, 0);
        stored = record.strain_energy;
      }
  }
} // namespace



TEST(Energies, WorkIsStoredOrLost)
{
  Story held("Displacement = 0.01*t; -0.02*t");
  expect_first_law(held);
  Story smooth("Displacement = 0.01*t; -0.02*t", "", "");
  expect_first_law(smooth);
  Story moving("Displacement = 0", "|Displacement = 0.1*t; 0.2*t^2");
  expect_first_law(moving);
  Story springs("Displacement = 0.01*t; -0.02*t|Stiffness = 50");
  expect_first_law(springs);
}



TEST(Energies, OfABarThatIsPressed)
{
  Story           story("Displacement = 0");
  Eigen::VectorXd u   = Eigen::VectorXd::Zero(6);
  u[0]                = .01; // the base, k = 50, and a leg of sqrt(50)
  const double energy = .5 * (50 + 50 / std::sqrt(2)) * .01 * .01;
  const auto   loaded = story.next(1, u, Eigen::VectorXd::Zero(4));
  EXPECT_NEAR(loaded.strain_energy, energy, 1e-16);
  EXPECT_NEAR(loaded.external_work, energy, 1e-16);
  EXPECT_EQ(loaded.dissipation, 0);
  const auto back =
    story.next(2, Eigen::VectorXd::Zero(6), Eigen::VectorXd::Zero(4));
  EXPECT_NEAR(back.strain_energy, 0, 1e-16);
  EXPECT_NEAR(back.external_work, -energy, 1e-16);
}



// friction 2 over a slip of .1 at a constant pressure; the first increment
// presses, at no slip
TEST(Energies, FrictionTimesSlipIsLost)
{
  Story                 story("Displacement = 0");
  const Eigen::Vector4d r(-2, 4, 0, 0);
  EXPECT_EQ(story.next(1, Eigen::VectorXd::Zero(6), r).dissipation, 0);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6);
  u[0]              = .1;
  const auto slid   = story.next(2, u, r);
  EXPECT_NEAR(slid.dissipation, .2, 1e-15);
  EXPECT_EQ(slid.contact_work_normal, 0);
}



// a floor that lifts a body which nothing strains does the work of its weight
TEST(Energies, AFloorThatLifts)
{
  Story story("Displacement = 0; 0.5*t", "|Displacement = 0; 0.5*t");
  const Eigen::Vector4d r(0, 3, 0, 3);
  Eigen::VectorXd       u = Eigen::VectorXd::Zero(6);
  for (const double t : {1., 2.})
    {
      u[1] = u[3]       = .5 * t;
      const auto record = story.next(t, u, r);
      EXPECT_NEAR(record.strain_energy, 0, 1e-14);
      EXPECT_NEAR(record.external_work, 0, 1e-14);
      EXPECT_NEAR(record.contact_work_normal, 0, 1e-14);
    }
}
