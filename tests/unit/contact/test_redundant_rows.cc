// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/redundant_rows.h"

#include <gtest/gtest.h>

namespace
{
  using conetact::contact::find_redundant_rows;
  using conetact::contact::RedundantRows;
  using Eigen::MatrixXd;

  /** Two nodes of three rows each; a support has left the first two unknowns
   * of the first node only, whatever way it is turned. */
  MatrixXd
  held(const double angle, const double rounding)
  {
    MatrixXd     rows = MatrixXd::Zero(6, 5);
    const double c = std::cos(angle), s = std::sin(angle);
    rows.topLeftCorner(3, 2) << c, s * c, s, -c * c, rounding, s;
    rows.bottomRightCorner(3, 3) << c, s, 0, -s, c, 0, 0, 0, 1;
    return rows;
  }

  TEST(RedundantRows, RoundingDoesNotCount)
  {
    for (const double angle : {0., .1, 1., 2.})
      for (const double rounding : {0., 1e-17, -1e-15})
        {
          const MatrixXd      rows = held(angle, rounding);
          const RedundantRows redundant =
            find_redundant_rows(rows.sparseView(), {0, 3, 6});
          ASSERT_EQ(redundant.open.cols(), 1) << angle << " " << rounding;
          const MatrixXd open = redundant.open;
          EXPECT_LT((rows.transpose() * open).norm(), 1e-14);
          EXPECT_NEAR(open.norm(), 1, 1e-14);
          ASSERT_EQ(redundant.independent.size(), 5);
          const MatrixXd left = rows(redundant.independent, Eigen::all);
          EXPECT_EQ(Eigen::FullPivLU<MatrixXd>(left).rank(), 5);
        }
  }

  TEST(RedundantRows, WithoutAnyAllStay)
  {
    MatrixXd rows(4, 5); // the second node shares all its unknowns
    rows << 1, 0, .5, .5, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1e-4, 0, 0, 0, 0, 1, -1;
    const RedundantRows redundant =
      find_redundant_rows(rows.sparseView(), {0, 2, 4});
    EXPECT_EQ(redundant.open.cols(), 0);
    EXPECT_EQ(redundant.independent, (std::vector<Eigen::Index>{0, 1, 2, 3}));
  }

  TEST(RedundantRows, ARowOfNothingButRoundingIsHeldByOthers)
  {
    MatrixXd rows(2, 2);
    rows << 1e-17, -1e-16, 1, 0;
    const RedundantRows redundant =
      find_redundant_rows(rows.sparseView(), {0, 1, 2});
    ASSERT_EQ(redundant.open.cols(), 1);
    EXPECT_EQ(redundant.independent, std::vector<Eigen::Index>{1});
    EXPECT_EQ(redundant.least(Eigen::Vector2d(7, 3)), Eigen::Vector2d(0, 3));
  }
} // namespace
