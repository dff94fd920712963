// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/row_runs.h"

#include <gtest/gtest.h>

namespace
{
  using namespace conetact::iterative;

  /**
   * Lines of nodes one behind the other, each node with those beside it along
   * its own line and the next ones; all rows inside of a line have the same
   * numbers unless each shall have its own.
   */
  template <int block, typename Number>
  BlockMatrix<block, block, Number>
  lines(const int  length,
        const int  n_lines,
        const bool equal,
        const bool shared = true)
  {
    using Block                      = Eigen::Matrix<Number, block, block>;
    const int                      n = length * n_lines;
    RowByRow<block, block, Number> rows(shared);
    for (int i = 0; i < n; ++i)
      {
        std::vector<int>    columns;
        std::vector<Number> numbers;
        for (const int j : {i - length - 1,
                            i - length,
                            i - length + 1,
                            i - 1,
                            i,
                            i + 1,
                            i + length - 1,
                            i + length,
                            i + length + 1})
          if (j >= 0 && j < n && std::abs(j % length - i % length) <= 1)
            {
              columns.push_back(j);
              const Block a = Block::NullaryExpr([&](auto r, auto c) {
                return static_cast<Number>(
                  std::sin(3. * (j - i) + 5. * static_cast<double>(r) +
                           7. * static_cast<double>(c) + (equal ? 0 : i)));
              });
              numbers.insert(numbers.end(), a.data(), a.data() + a.size());
            }
        rows.append(columns.data(), columns.size(), numbers);
      }
    return rows.finish();
  }

  template <int block, typename Number>
  void
  expect_same_product(const int  length,
                      const int  n_lines,
                      const bool equal,
                      const bool has_runs)
  {
    using Vector   = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    const auto   A = lines<block, Number>(length, n_lines, equal);
    const auto   n = static_cast<Eigen::Index>(A.n_block_rows()) * block;
    const Vector x = Vector::Random(n);
    Vector       y(n), expected(n);
    const RowRuns<block, Number> product(A);
    product(x.data(), y.data());
    A.multiply(x.data(), expected.data());
    EXPECT_LT((y - expected).norm(),
              20 * std::numeric_limits<Number>::epsilon() * expected.norm())
      << length;
    EXPECT_EQ(product.n_rows() > 0, has_runs) << length;
  }

  template <int block, typename Number>
  void
  expect_same_products()
  {
    // around one, two and three strips of vectors
    for (const int length : {17, 18, 19, 33, 34, 35, 47, 50, 51, 66, 100})
      expect_same_product<block, Number>(
        length, 40, true, length - 2 >= 64 / int(sizeof(Number)));
    // runs shorter than a vector, and rows by themselves at the ends of lines
    expect_same_product<block, Number>(6, 100, true, false);
    expect_same_product<block, Number>(18, 300, true, true);
    expect_same_product<block, Number>(50, 40, false, false);
    expect_same_product<block, Number>(50, 5, true, false); // too few rows
  }
} // namespace



TEST(RowRuns, MultiplyAsOtherRowsDo)
{
  expect_same_products<2, float>();
  expect_same_products<2, double>();
  expect_same_products<3, float>();
  expect_same_products<3, double>();
}



TEST(RowRuns, LeaveOutRowsThatChange)
{
  auto                    A        = lines<6, float>(40, 40, true, false);
  const std::vector<int>  changing = {0, 500, 501, 777, 1599};
  const RowRuns<6, float> product(A, changing);
  EXPECT_GT(product.n_rows(), 1000u);
  for (const int i : changing)
    for (std::size_t k = A.start[static_cast<std::size_t>(i)];
         k < A.start[static_cast<std::size_t>(i) + 1];
         ++k)
      A.block(k) *= 2.f;
  const Eigen::VectorXf x = Eigen::VectorXf::Random(6 * 1600);
  Eigen::VectorXf       y(6 * 1600), expected(6 * 1600);
  product(x.data(), y.data());
  A.multiply(x.data(), expected.data());
  EXPECT_LT((y - expected).norm(), 1e-6 * expected.norm());
}



TEST(RowRuns, EqualRowsAreKeptOnce)
{
  const auto A    = lines<3, float>(40, 40, true, false);
  const auto kept = with_equal_rows(A);
  EXPECT_FALSE(A.shares_rows());
  EXPECT_TRUE(kept.shares_rows());
  EXPECT_LT(20 * kept.value.size(), A.value.size());
  EXPECT_FALSE(
    with_equal_rows(lines<3, float>(40, 40, false, false)).shares_rows());
  const Eigen::VectorXf x = Eigen::VectorXf::Random(3 * 1600);
  Eigen::VectorXf       y(3 * 1600), expected(3 * 1600);
  kept.multiply(x.data(), y.data());
  A.multiply(x.data(), expected.data());
  EXPECT_EQ(y, expected);
}
