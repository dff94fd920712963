// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/column_groups.h"
#include "conetact/solvers/null_space.h"

#include <gtest/gtest.h>

using namespace conetact::solvers;
using Eigen::Index;
using Eigen::MatrixXd;

namespace
{
  using Indices = std::vector<Index>;

  /** Motions of three bodies, the first and the last of which meet. */
  MatrixXd
  of_three_bodies()
  {
    MatrixXd M = MatrixXd::Zero(7, 5);
    M(0, 0)    = 1;
    M(1, 0)    = 2;
    M(1, 3)    = 3;
    M(6, 3)    = -1;
    M(3, 1)    = 4;
    M(4, 2)    = 5;
    M.row(5)   = 2 * M.row(4) + M.row(3);
    M(2, 4)    = 0;
    return M;
  }
} // namespace



TEST(ColumnGroups, HaveNoRowInCommon)
{
  const auto groups = column_groups(of_three_bodies());
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].columns, (Indices{0, 3}));
  EXPECT_EQ(groups[0].blocks, (Indices{0, 1, 6}));
  EXPECT_EQ(groups[1].columns, (Indices{1, 2}));
  EXPECT_EQ(groups[1].blocks, (Indices{3, 4, 5}));
  EXPECT_EQ(groups[2].columns, (Indices{4}));
  EXPECT_TRUE(groups[2].blocks.empty());
}



TEST(ColumnGroups, AreJoinedByBlocks)
{
  const auto groups = column_groups(of_three_bodies(), {0, 1, 3, 5, 7});
  ASSERT_EQ(groups.size(), 2u); // row 6 is in the block of row 5
  EXPECT_EQ(groups[0].columns, (Indices{0, 1, 2, 3}));
  EXPECT_EQ(groups[0].blocks, (Indices{0, 1, 2, 3}));
}



TEST(ColumnGroups, SpanWhatAllColumnsSpan)
{
  MatrixXd M(7, 6);
  M << of_three_bodies(), of_three_bodies().col(3) * 2;
  const MatrixXd basis = orthonormal_basis(M);
  ASSERT_EQ(basis.cols(), 4); // a column of zeros, and one that depends
  EXPECT_LT((basis.transpose() * basis - MatrixXd::Identity(4, 4)).norm(),
            1e-14);
  EXPECT_LT((M - basis * (basis.transpose() * M)).norm(), 1e-13);
  EXPECT_EQ(column_groups(basis).size(), 2u);
}
