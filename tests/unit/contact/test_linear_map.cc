// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/linear_map.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace conetact;
using namespace conetact::contact;

// u_0 = 2 q_1, u_1 = 0, u_2 = q_0 - 3 q_1 + q_0, u_3 = q_1
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
  map.append(1, 1);
  map.end_row();
  EXPECT_EQ(map.n_unknowns(), 2);
  EXPECT_EQ(map.n_rows(), 4);
  using Entries         = std::vector<std::pair<Eigen::Index, double>>;
  const auto entries_of = [&](const Eigen::Index row) {
    Entries entries;
    map.for_row(row, [&](const Eigen::Index unknown, const double factor) {
      entries.emplace_back(unknown, factor);
    });
    return entries;
  };
  EXPECT_EQ(entries_of(0), (Entries{{1, 2.}}));
  EXPECT_EQ(entries_of(1), Entries());
  EXPECT_EQ(entries_of(2), (Entries{{0, 1.}, {1, -3.}, {0, 1.}}));
  EXPECT_EQ(entries_of(3), (Entries{{1, 1.}}));
  EXPECT_EQ(map.plain(3), 1);
  for (Eigen::Index row = 0; row < 3; ++row)
    EXPECT_LT(map.plain(row), 0);
  EXPECT_EQ(map.expand(Eigen::Vector2d(1, 10)),
            Eigen::Vector4d(20, 0, -28, 10));
  EXPECT_EQ(map.restrict(Eigen::Vector4d(1, 5, 10, 100)),
            Eigen::Vector2d(20, 72));
}
