// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/growing_set.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

namespace
{
  /** A triangle whose feet, nodes 0 and 1, may touch. */
  class Feet : public testing::Test
  {
  protected:
    std::unique_ptr<application::Scene> scene = test::make_scene(
      test::triangle_on_floor("set Supports = top\n", test::held_top()));
    ContactModel model{scene->bodies, {1}};

    void
    choose(const std::vector<Eigen::Index> &nodes)
    {
      model.choose(WorkingSet(model.points.layout(), nodes));
    }
  };
} // namespace



TEST_F(Feet, CandidatesOutsideThatPenetrateJoin)
{
  choose({0});
  GrowingSet set(model);
  EXPECT_EQ(set.size_at_start(), 1u);
  EXPECT_TRUE(set.suffices(Eigen::Vector2d(0, .1)));
  EXPECT_TRUE(set.suffices(Eigen::Vector2d(-.1, .1))); // the solver's affair
  const Eigen::Vector2d below(0, -.1);
  EXPECT_FALSE(set.suffices(below));
  EXPECT_EQ(set.extend(below), 1u);
  EXPECT_TRUE(set.suffices(below));
  EXPECT_EQ(set.size(), 2u);
  EXPECT_EQ(set.size_at_start(), 1u);
  EXPECT_EQ(set.n_extensions(), 1u);
  EXPECT_TRUE(model.working_set().contains(1));
}



TEST_F(Feet, AllAreTakenOnce)
{
  choose({1});
  GrowingSet set(model);
  EXPECT_TRUE(set.take_all());
  EXPECT_TRUE(model.working_set().is_all());
  EXPECT_FALSE(set.take_all());
  EXPECT_EQ(set.n_extensions(), 0u);
}



TEST_F(Feet, StartsFromAGuess)
{
  choose({1});
  GrowingSet set(model);
  set.start(
    [&](const double) {
      return Eigen::VectorXd::Zero(model.coordinates.n_dofs());
    },
    {1});
  EXPECT_EQ(set.size_at_start(), 2u); // so few are all taken
  EXPECT_EQ(set.size(), 2u);
}



// the system of a set that grew is that of the same set made at once
TEST_F(Feet, StiffnessDoesNotRememberHowTheSetGrew)
{
  const Eigen::MatrixXd whole = model.condense().system()->matrix;
  choose({1});
  model.condense();
  GrowingSet set(model);
  set.extend(Eigen::Vector2d(-1, 0));
  const Eigen::MatrixXd          &K     = model.condense().system()->matrix;
  const std::vector<Eigen::Index> order = model.working_set().unknowns();
  EXPECT_LE((K - whole(order, order)).norm(), 1e-13 * whole.norm());
}
