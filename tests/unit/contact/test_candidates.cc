// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/candidates.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

namespace
{
  /** A strip over a bowl that touches it at x = 12, `cells` along it. */
  std::string
  strip(const unsigned int cells)
  {
    return "set Dimension = 2\nset Bodies = strip\nset Obstacles = bowl\n"
           "set Contacts = below\nset Supports = top\nsubsection Body strip\n" +
           test::section("Mesh",
                         "Generator = subdivided_hyper_rectangle|Arguments = " +
                           std::to_string(cells) +
                           ", 1 : 0, 0 : 24, 2 : true") +
           test::section("Material", "Young modulus = 100|Poisson ratio = 0") +
           "end\n" +
           test::section("Obstacle bowl",
                         "Shape = prescribed gap|Normal = 0, 1|"
                         "Gap = 0.01*(x - 12)^2") +
           test::section("Contact below",
                         "Body = strip|Boundary ids = 2|Obstacle = bowl|"
                         "Friction coefficient = 0.3") +
           test::section("Support top",
                         "Body = strip|Boundary ids = 3|Directions = x, y|"
                         "Displacement = 0 ; -0.01*t");
  }

  WorkingSet
  guess(const ContactModel &model, const std::vector<double> &times)
  {
    return guess_working_set(
      model,
      [&](const double) {
        return Eigen::VectorXd::Zero(model.coordinates.n_dofs());
      },
      times);
  }
} // namespace



// the support brings what is less than .01 above the bowl, |x - 12| < 1
TEST(Candidates, WhatSupportsBringCloseIsGuessed)
{
  const auto         scene = test::make_scene(strip(120));
  const ContactModel model(scene->bodies, {1});
  const WorkingSet   set = guess(model, {1});
  EXPECT_FALSE(set.is_all());
  for (Eigen::Index i = 0; i < set.n_candidates(); ++i)
    {
      const double x = model.points[i].node->position[0];
      if (std::abs(x - 12) < 1 || std::abs(x - 12) > 4)
        {
          EXPECT_EQ(set.contains(i), std::abs(x - 12) < 1) << x;
        }
    }
  // four times the way, twice the width
  EXPECT_NEAR(static_cast<double>(guess(model, {4}).nodes().size()),
              2 * static_cast<double>(set.nodes().size()),
              4);
}



TEST(Candidates, AFewAreAllTaken)
{
  const auto         scene = test::make_scene(strip(20));
  const ContactModel model(scene->bodies, {1});
  EXPECT_TRUE(guess(model, {1}).is_all());
}



TEST(Candidates, OnlyWhatIsLeftOutMayBeMissed)
{
  const auto   scene = test::make_scene(strip(20));
  ContactModel model(scene->bodies, {1});
  model.choose(WorkingSet(model.points.layout(), {10}));
  Eigen::VectorXd gaps = Eigen::VectorXd::Constant(21, .1);
  gaps[10] = gaps[3] = -.01;
  gaps[4]            = -1e-15; // round-off
  EXPECT_EQ(penetrating(model, gaps), (std::vector<Eigen::Index>{3}));
}
