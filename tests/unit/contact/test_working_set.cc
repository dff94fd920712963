// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/working_set.h"

#include <gtest/gtest.h>

using namespace conetact;
using namespace conetact::contact;
using namespace conetact::solvers;

namespace
{
  /** Three candidates with two, one and three unknowns. */
  ContactSystem
  candidates()
  {
    ContactSystem system;
    system.first = {0, 2, 3, 6};
    system.mu    = Eigen::Vector3d(.1, 0, .3);
    return system;
  }
} // namespace



TEST(WorkingSet, AllCandidatesAreTheSet)
{
  const WorkingSet set(candidates());
  EXPECT_TRUE(set.is_all());
  EXPECT_EQ(set.layout().first, candidates().first);
  EXPECT_EQ(set.layout().mu, candidates().mu);
  EXPECT_TRUE(WorkingSet(candidates(), {0, 1, 2}).is_all());
  EXPECT_FALSE(WorkingSet(candidates(), {0, 2, 1}).is_all());
}



TEST(WorkingSet, KeepsItsOwnOrder)
{
  const WorkingSet set(candidates(), {2, 0});
  EXPECT_FALSE(set.is_all());
  EXPECT_EQ(set.n_candidates(), 3);
  EXPECT_TRUE(set.contains(2));
  EXPECT_FALSE(set.contains(1));
  EXPECT_EQ(set.layout().first, (std::vector<Eigen::Index>{0, 3, 5}));
  EXPECT_EQ(set.layout().mu, Eigen::Vector2d(.3, .1));
  EXPECT_EQ(set.unknowns(), (std::vector<Eigen::Index>{3, 4, 5, 0, 1}));
}



TEST(WorkingSet, ValuesGoThereAndBack)
{
  const WorkingSet set(candidates(), {2, 0});
  Eigen::VectorXd  all(6);
  all << 0, 1, 2, 3, 4, 5;
  Eigen::VectorXd own(5);
  own << 3, 4, 5, 0, 1;
  EXPECT_EQ(set.gather(all), own);
  set.scatter(10 * own, all);
  Eigen::VectorXd expected(6);
  expected << 0, 10, 2, 30, 40, 50;
  EXPECT_EQ(all, expected);
}



TEST(WorkingSet, WhatIsLeftOutIsOpen)
{
  using State = NodeState;
  const WorkingSet         set(candidates(), {2, 0});
  const std::vector<State> all = {State::slip, State::stick, State::stick};
  const std::vector<State> own = {State::stick, State::slip};
  EXPECT_EQ(set.gather(all), own);
  EXPECT_EQ(set.scatter(own),
            (std::vector<State>{State::slip, State::open, State::stick}));
  EXPECT_TRUE(set.gather(std::vector<State>()).empty());
}
