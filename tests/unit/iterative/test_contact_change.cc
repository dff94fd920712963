// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/contact_change.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace conetact::iterative;
  using Eigen::MatrixXf;

  /** Blocks that are zero are left out. */
  template <int n_rows, int n_columns>
  BlockMatrix<n_rows, n_columns, float>
  to_blocks(const MatrixXf &A)
  {
    BlockMatrix<n_rows, n_columns, float> result;
    for (int i = 0; i < A.rows() / n_rows; ++i)
      {
        for (int j = 0; j < A.cols() / n_columns; ++j)
          {
            const Eigen::Matrix<float, n_rows, n_columns> block =
              A.block<n_rows, n_columns>(i * n_rows, j * n_columns);
            if (block.isZero(0))
              continue;
            result.column.push_back(j);
            result.value.insert(result.value.end(),
                                block.data(),
                                block.data() + block.size());
          }
        result.start.push_back(result.column.size());
      }
    return result;
  }

  template <int n_rows, int n_columns>
  DistributedMatrix<n_rows, n_columns, float>
  to_matrix(const MatrixXf &A)
  {
    return {to_blocks<n_rows, n_columns>(A),
            {0, static_cast<int>(A.cols()) / n_columns},
            conetact::Communicator()};
  }

  MatrixXf
  dense(const SomeRows<6, 6> &rows, const int n)
  {
    MatrixXf A = MatrixXf::Zero(6 * n, 6 * n);
    for (std::size_t i = 0; i < rows.number.size(); ++i)
      rows.for_row(i, [&](const int j, const auto &block) {
        A.block<6, 6>(rows.number[i] * 6, j * 6) = block;
      });
    return A;
  }

  /** Band matrices of blocks. */
  template <int n_rows, int n_columns>
  MatrixXf
  random_band(const int n, const int m, const int width)
  {
    static std::mt19937                   engine(1);
    std::uniform_real_distribution<float> number(-1, 1);
    MatrixXf A = MatrixXf::Zero(n_rows * n, n_columns * m);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < m; ++j)
        if (std::abs(i * m / n - j) <= width)
          A.block<n_rows, n_columns>(i * n_rows, j * n_columns) =
            MatrixXf::NullaryExpr(n_rows, n_columns, [&] {
              return number(engine);
            });
    return A;
  }
} // namespace



TEST(ContactChange, IsWhatTheStateChangesOfAllLevels)
{
  constexpr int  n = 24, n_1 = 8, n_2 = 3;
  const MatrixXf half = random_band<3, 3>(n, n, 1);
  const MatrixXf A = half + half.transpose(), P = random_band<3, 6>(n, n_1, 1),
                 P_2               = random_band<6, 6>(n_1, n_2, 1);
  const std::vector<int>    nodes  = {5, 2, 3, 23};
  std::vector<NodeState<3>> states = {{{1, 1, 1}, Eigen::Matrix3f::Zero()},
                                      {{0, 0, 0}, Eigen::Matrix3f::Zero()},
                                      {{0, 0, 1}, Eigen::Matrix3f::Zero()},
                                      {{0, 1, 1}, Eigen::Matrix3f::Zero()}};
  states[2].added << 2, 1, 0, 1, 3, 0, 0, 0, 0;

  MatrixXf held = MatrixXf::Zero(3 * n, 3 * n), added = held;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      held.diagonal().segment<3>(3 * nodes[i])      = states[i].held;
      added.block<3, 3>(3 * nodes[i], 3 * nodes[i]) = states[i].added;
    }
  const MatrixXf free = MatrixXf::Identity(3 * n, 3 * n) - held,
                 diagonal(A.diagonal().asDiagonal()),
                 change = free * A * free + held * diagonal * held + added - A;

  ContactChange<3, 6> contact(
    to_matrix<3, 3>(A), nodes, {0, n}, to_matrix<3, 6>(P), {});
  contact.add_level(to_matrix<6, 6>(P_2), 0, {});
  const auto     result = contact.change(states);
  const MatrixXf first  = P.transpose() * change * P,
                 second = P_2.transpose() * first * P_2;
  ASSERT_EQ(result.size(), 2u);
  EXPECT_LT((dense(result[0], n_1) - first).norm(), 1e-5 * first.norm());
  EXPECT_LT((dense(result[1], n_2) - second).norm(), 1e-5 * second.norm());
}
