// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/node_sets.h"

#include <gtest/gtest.h>

using namespace conetact::solvers;

namespace
{
  /** A body on two nodes of the x axis at -1 and 1, in the plane or in space:
   * translations and the rotation that lifts one of them. */
  ContactSystem
  on_two_nodes(const Eigen::Index dim)
  {
    ContactSystem system;
    system.first      = {0, dim, 2 * dim};
    system.mu         = Eigen::VectorXd::Constant(2, .3);
    system.null_space = Eigen::MatrixXd::Zero(2 * dim, dim + 1);
    for (Eigen::Index i = 0; i < 2; ++i)
      {
        system.null_space.block(dim * i, 0, dim, dim).setIdentity();
        system.null_space(dim * i + dim - 1, dim) = i == 0 ? -1e3 : 1e3;
      }
    return system;
  }

  NodeSets
  sets_of(const std::vector<NodeState> &states, const Eigen::Index dim)
  {
    NodeSets sets;
    for (const NodeState state : states)
      {
        SmallVector along = SmallVector::Zero(dim - 1);
        along(0)          = 1;
        sets.push_back({state, along, .5});
      }
    return sets;
  }
} // namespace

TEST(NodeSets, WhatSticksOrTurnsHoldsABody)
{
  constexpr NodeState open = NodeState::open, stick = NodeState::stick,
                      slip = NodeState::slip;
  for (const Eigen::Index dim : {2, 3})
    {
      const ContactSystem system = on_two_nodes(dim);
      EXPECT_TRUE(resist_motions(system, sets_of({stick, stick}, dim)));
      EXPECT_TRUE(resist_motions(system, sets_of({slip, stick}, dim)));
      EXPECT_FALSE(resist_motions(system, sets_of({slip, slip}, dim)));
      EXPECT_FALSE(resist_motions(system, sets_of({stick, open}, dim)));
    }
  // slips in different directions oppose every one of them
  NodeSets crossed = sets_of({slip, slip}, 3);
  crossed[1].direction << 0, 1;
  EXPECT_TRUE(resist_motions(on_two_nodes(3), crossed));
}

TEST(NodeSets, WhatFrictionCannotHoldDoesNotCount)
{
  ContactSystem system = on_two_nodes(2);
  system.mu.setZero();
  const NodeSets closed = sets_of({NodeState::slip, NodeState::slip}, 2);
  EXPECT_FALSE(resist_motions(system, closed));
  system.null_space.col(0).setZero(); // no contact sees it
  EXPECT_TRUE(resist_motions(system, closed));
  system.null_space.resize(4, 0);
  EXPECT_TRUE(resist_motions(system, closed));
}
