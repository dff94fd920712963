// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/distributed_matrix.h"
#include "conetact/iterative/node_blocks.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

using namespace conetact::iterative;
using Eigen::Index;

namespace
{
  /** Row i has blocks in i % 5 columns. */
  template <int n_rows, int n_columns, typename Number>
  BlockMatrix<n_rows, n_columns, Number>
  uneven_rows(const int n)
  {
    using Numbers = Eigen::Matrix<Number, n_rows, n_columns>;
    RowByRow<n_rows, n_columns, Number> rows(false);
    for (int i = 0; i < n; ++i)
      {
        std::vector<int>    columns;
        std::vector<Number> numbers;
        for (int k = 0; k < i % 5; ++k)
          {
            const Numbers block = Numbers::Random();
            columns.push_back(3 * k + i % 2);
            numbers.insert(numbers.end(),
                           block.data(),
                           block.data() + block.size());
          }
        rows.append(columns.data(), columns.size(), numbers);
      }
    return rows.finish();
  }

  template <int n_rows, int n_columns, typename Number>
  void
  expect_product()
  {
    using Vector                = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    constexpr Index   n         = 33;
    constexpr int     untouched = 7;
    const auto        A         = uneven_rows<n_rows, n_columns, Number>(n);
    const Vector      x         = Vector::Random(14 * n_columns);
    Vector            y         = Vector::Constant(n * n_rows, untouched);
    Vector            expected  = y;
    const std::size_t begin = 2, end = 31;
    for (std::size_t i = begin; i < end; ++i)
      {
        auto row = expected.template segment<n_rows>(Index(i) * n_rows);
        row.setZero();
        for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
          row += A.block(i, k) *
                 x.template segment<n_columns>(Index(A.column[k]) * n_columns);
      }
    A.multiply(begin, end, x.data(), y.data());
    EXPECT_LT((y - expected).norm(),
              20 * std::numeric_limits<Number>::epsilon() * expected.norm());
    for (const Index i : {Index(0), n - 1}) // rows that nobody asked for
      EXPECT_EQ(y.template segment<n_rows>(i * n_rows),
                expected.template segment<n_rows>(i * n_rows));
    EXPECT_EQ(y[31 * n_rows], untouched);
  }

  /** A symmetric matrix with the blocks from the diagonal on, of other columns
   * in each row; the dense one beside it. */
  template <int size, typename Number>
  void
  expect_symmetric_product()
  {
    using Block  = Eigen::Matrix<Number, size, size>;
    using Dense  = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    constexpr int                   n = 40;
    BlockMatrix<size, size, Number> A;
    Dense                           dense = Dense::Zero(n * size, n * size);
    for (int i = 0; i < n; ++i)
      {
        for (int j = i; j < n; j += 1 + (i + j) % 4)
          {
            Block block = Block::Random();
            if (j == i)
              block = (block + block.transpose()).eval();
            A.column.push_back(j);
            A.value.insert(A.value.end(),
                           block.data(),
                           block.data() + block.size());
            dense.template block<size, size>(j * size, i * size) =
              block.transpose();
            dense.template block<size, size>(i * size, j * size) = block;
          }
        A.start.push_back(A.column.size());
      }
    A.value.resize(A.value.size() + lanes(size));
    A.is_upper      = true;
    const Vector x  = Vector::Random(n * size);
    Vector       y  = Vector::Constant(n * size, 7);
    const auto   is = [](const Vector &found, const Vector &right) {
      return (found - right).norm() <
             20 * std::numeric_limits<Number>::epsilon() * right.norm();
    };
    A.multiply(x.data(), y.data());
    EXPECT_TRUE(is(y, dense * x));

    // as in DistributedMatrix, whose rows come back whole; some of them serve
    // a vector that is zero but for one node
    Vector one = Vector::Zero(n * size);
    one.template segment<size>(9 * size).setConstant(2);
    const DistributedMatrix<size, size, Number> whole(std::move(A),
                                                      {0, n},
                                                      conetact::Communicator());
    std::vector<std::size_t>                    some;
    Dense rows = Dense::Zero(n * size, n * size);
    for (int i = 0; i < n; ++i)
      whole.for_row(static_cast<std::size_t>(i),
                    [&](const int j, const auto &block) {
                      rows.template block<size, size>(i * size, j * size) =
                        block;
                      if (j == 9)
                        some.push_back(static_cast<std::size_t>(i));
                    });
    EXPECT_EQ(rows, dense);
    y.setZero();
    whole.own_part().multiply_some(some, one.data(), y.data());
    EXPECT_TRUE(is(y, dense * one));
  }

  /** One of three blocks for each node. */
  template <int size>
  std::vector<Eigen::Matrix<float, size, size>>
  three_kinds(const int n)
  {
    using Block                      = Eigen::Matrix<float, size, size>;
    const std::array<Block, 3> kinds = {
      {Block::Random(), Block::Random(), Block::Random()}};
    std::vector<Block> blocks;
    for (int i = 0; i < n; ++i)
      blocks.push_back(kinds[static_cast<std::size_t>(i * i % 3)]);
    return blocks;
  }

  template <int size>
  void
  expect_scaled()
  {
    constexpr int    n      = 1000; // more than a piece
    auto             blocks = three_kinds<size>(n);
    NodeBlocks<size> D(blocks);
    ASSERT_EQ(D.n_nodes(), static_cast<std::size_t>(n));
    // twice the same node, which has its own one then
    for (const std::size_t i : {0u, 500u, 999u, 500u})
      {
        blocks[i].setRandom();
        D.set(i, blocks[i]);
      }
    const FloatVector x = FloatVector::Random(n * size);
    FloatVector       r = 2 * x, seen(n * size), expected(n * size);
    D.for_products(
      r,
      [&](const Index begin, const Index length) {
        r.segment(begin, length) -= x.segment(begin, length);
      },
      [&](const Index begin, const auto &product) {
        seen.segment(begin, product.size()) = product;
      });
    for (int i = 0; i < n; ++i)
      {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_EQ(D[k], blocks[k]);
        expected.segment<size>(i * size) =
          blocks[k] * x.segment<size>(i * size);
      }
    EXPECT_LT((r - x).norm(), 1e-6 * x.norm());
    EXPECT_LT((seen - expected).norm(), 1e-6 * expected.norm());
  }
} // namespace



TEST(BlockProducts, AreThoseOfDenseBlocks)
{
  expect_product<2, 2, float>();
  expect_product<2, 2, double>();
  expect_product<2, 3, float>();
  expect_product<3, 2, float>();
  expect_product<3, 3, float>();
  expect_product<3, 3, double>();
  expect_product<3, 6, float>();
  expect_product<6, 3, float>();
  expect_product<6, 6, float>();
  expect_product<6, 6, double>();
}



TEST(BlockProducts, OfAnUpperTriangleAreThoseOfTheWholeMatrix)
{
  expect_symmetric_product<2, float>();
  expect_symmetric_product<2, double>();
  expect_symmetric_product<3, float>();
  expect_symmetric_product<3, double>();
}



TEST(NodeBlocks, ScaleEachNodeByItsBlock)
{
  expect_scaled<2>();
  expect_scaled<3>();
  expect_scaled<6>();
}



namespace
{
  template <int size>
  void
  expect_products_with_blocks()
  {
    using Block               = Eigen::Matrix<float, size, size>;
    using Blocks              = Eigen::Matrix<float, size, Eigen::Dynamic>;
    constexpr int      n      = 7;
    constexpr float    beyond = 5;
    const Block        factor = Block::Random();
    const Blocks       blocks = Blocks::Random(size, n * size);
    std::vector<float> given(factor.data(), factor.data() + factor.size());
    given.resize(given.size() + lanes(size),
                 std::numeric_limits<float>::quiet_NaN());
    std::vector<float> result(n * factor.size() + lanes(size), beyond);
    multiply_blocks<size>(given.data(), blocks.data(), n, result.data());
    const Blocks expected = factor * blocks;
    EXPECT_LE((Eigen::Map<const Blocks>(result.data(), size, n * size) -
               expected)
                .cwiseAbs()
                .maxCoeff(),
              1e-6);
    multiply_blocks<size>(given.data(), blocks.data(), 0, result.data());
  }
} // namespace

TEST(BlockProducts, OfOneBlockWithMany)
{
  expect_products_with_blocks<3>();
  expect_products_with_blocks<6>();
}
