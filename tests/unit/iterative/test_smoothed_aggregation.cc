// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/smoothed_aggregation.h"

#include <gtest/gtest.h>

namespace
{
  using namespace conetact::iterative;
  using Eigen::Matrix2d;
  using Eigen::MatrixXd;

  /** Springs along a row of nodes that nothing holds; those from node `hard`
   * on are a million times as stiff. */
  DistributedMatrix<2, 2, double>
  chain(const int n, const int hard)
  {
    const auto spring = [&](const int i) {
      return i < 0 || i + 1 >= n ? 0. : i < hard ? 1. : 1e6;
    };
    BlockMatrix<2, 2, double> A;
    for (int i = 0; i < n; ++i)
      {
        for (int j = std::max(i - 1, 0); j <= std::min(i + 1, n - 1); ++j)
          {
            const double a =
              i == j ? spring(i - 1) + spring(i) : -spring(std::min(i, j));
            const Matrix2d block = a * Matrix2d::Identity();
            A.column.push_back(j);
            A.value.insert(A.value.end(), block.data(), block.data() + 4);
          }
        A.start.push_back(A.column.size());
      }
    A.value.resize(A.value.size() + 4);
    return {std::move(A), {0, n}, conetact::Communicator()};
  }

  template <int n_rows, int n_columns, typename Number>
  MatrixXd
  dense(const BlockMatrix<n_rows, n_columns, Number> &A, const int n)
  {
    const auto m      = static_cast<Eigen::Index>(A.n_block_rows());
    MatrixXd   result = MatrixXd::Zero(m * n_rows, Eigen::Index(n) * n_columns);
    for (std::size_t i = 0; i < A.n_block_rows(); ++i)
      for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
        result.block<n_rows, n_columns>(static_cast<Eigen::Index>(i) * n_rows,
                                        Eigen::Index(A.column[k]) * n_columns) =
          A.block(i, k).template cast<double>();
    return result;
  }

  CoarseLevel<2, 3>
  aggregates(const int n, const int hard, MatrixXd &A, MatrixXd &modes)
  {
    const auto                   matrix = chain(n, hard);
    std::vector<Eigen::Matrix2f> D;
    A = dense(matrix.own_part(), n);
    for (int i = 0; i < n; ++i)
      D.emplace_back((Matrix2d::Identity() / A(2 * i, 2 * i)).cast<float>());
    modes.resize(2 * n, 3);
    for (int i = 0; i < n; ++i)
      modes.middleRows<2>(2 * i) << 1, 0, 0, 0, 1, i;
    return aggregate<2, 3>({matrix, 1., NodeBlocks<2>(D), 2.f, modes}, {});
  }
} // namespace



TEST(SmoothedAggregation, KeepsMotionsWithoutStrain)
{
  MatrixXd   A, modes;
  const auto level = aggregates(40, 40, A, modes);
  const int  n     = level.rows.first.back();
  EXPECT_EQ(n, 14); // two nodes at each end, three each between them
  const MatrixXd P = dense(level.P, n), A_coarse = dense(level.rows.A, n);
  const MatrixXd moved = P * level.rows.modes;
  EXPECT_LT((moved - modes).leftCols(2).norm(), 1e-5);
  EXPECT_LT((A_coarse - P.transpose() * A * P).norm(), 1e-12 * A.norm());
}



TEST(SmoothedAggregation, HardAndSoftPartsAreApart)
{
  MatrixXd   A, modes;
  const auto level = aggregates(40, 21, A, modes);
  const int  n     = level.rows.first.back();
  // node 20 is the last soft one, and sees the first hard one
  const MatrixXd P = dense(level.P, n);
  for (int a = 0; a < n; ++a)
    EXPECT_TRUE(P.block(2 * 21, 3 * a, 2 * 19, 3).norm() < 1e-3 ||
                P.block(0, 3 * a, 2 * 20, 3).norm() < 1e-3)
      << "aggregate " << a;
}



/* Node 20 sees all others, as what opens a tie between nodes 19 and 21. */
TEST(SmoothedAggregation, WhatOpensATieStaysAlone)
{
  constexpr int             n = 41, alone = 20;
  BlockMatrix<2, 2, double> A;
  for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
        if (std::abs(i - j) <= 1 || i == alone || j == alone)
          {
            const Matrix2d block = (i == j ? 2. : -.1) * Matrix2d::Identity();
            A.column.push_back(j);
            A.value.insert(A.value.end(), block.data(), block.data() + 4);
          }
      A.start.push_back(A.column.size());
    }
  A.value.resize(A.value.size() + 4);
  const DistributedMatrix<2, 2, double> matrix(std::move(A),
                                               {0, n},
                                               conetact::Communicator());
  std::vector<int>                      side(n, 1);
  MatrixXd                              modes(2 * n, 3);
  for (int i = 0; i < n; ++i)
    {
      modes.middleRows<2>(2 * i) << 1, 0, 0, 0, 1, i;
      side[static_cast<std::size_t>(i)] = i < alone ? 1 : 2;
    }
  modes.middleRows<2>(2 * alone).setZero();
  side[alone] = -1;
  const std::vector<Eigen::Matrix2f> D(n, .5f * Eigen::Matrix2f::Identity());
  const auto                         level =
    aggregate<2, 3>({matrix, 1., NodeBlocks<2>(D), 2.f, modes, side}, {});
  const int      m       = level.rows.first.back();
  const MatrixXd P       = dense(level.P, m);
  int            n_alone = 0;
  for (int a = 0; a < m; ++a)
    {
      const int of = level.rows.side[static_cast<std::size_t>(a)];
      n_alone += of < 0 ? 1 : 0;
      // one step of smoothing reaches the next node
      const double left = P.block(0, 3 * a, 2 * (alone - 1), 3).norm();
      const double right =
        P.bottomRows(2 * (alone - 1)).middleCols<3>(3 * a).norm();
      EXPECT_TRUE(of < 0 || left == 0 || right == 0) << "aggregate " << a;
      // nothing but itself
      EXPECT_EQ(P.block(2 * alone, 3 * a, 2, 3).norm(), of < 0 ? 1. : 0.);
    }
  EXPECT_EQ(n_alone, 1);
}
