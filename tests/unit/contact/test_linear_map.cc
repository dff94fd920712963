// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/linear_map.h"

#include <gtest/gtest.h>

using namespace conetact;
using namespace conetact::contact;

// u_0 = 2 q_1, u_1 = 0, u_2 = q_0 - 3 q_1 + q_0
TEST(LinearMap, ByRowsAndByColumns)
{
  LinearMap map;
  map.set_n_unknowns(2);
  map.append(1, 2);
  map.end_row();
  map.end_row();
  map.append(0, 1);
  map.append(1, -3);
  map.append(0, 1);
  map.end_row();
  EXPECT_EQ(map.n_unknowns(), 2);
  EXPECT_EQ(map.row(1).first, map.row(1).second);
  EXPECT_EQ(map.row(0).first->unknown, 1);
  EXPECT_EQ(map.row(0).first->factor, 2);
  EXPECT_EQ(map.row(2).second - map.row(2).first, 3);
  EXPECT_EQ(map.expand(Eigen::Vector2d(1, 10)), Eigen::Vector3d(20, 0, -28));
  EXPECT_EQ(map.restrict(Eigen::Vector3d(1, 5, 10)), Eigen::Vector2d(20, -28));
}
