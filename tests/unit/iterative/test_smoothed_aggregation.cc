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
