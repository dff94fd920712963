// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/element_rows.h"

#include <gtest/gtest.h>

namespace conetact::iterative
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;

    /** An element of any unknowns. */
    struct Element
    {
      std::vector<Index> unknowns;
      MatrixXd           matrix;
    };

    Element
    element(const std::vector<Index> &unknowns)
    {
      const auto     n = static_cast<Index>(unknowns.size());
      const MatrixXd a = MatrixXd::Random(n, n);
      return {unknowns, a + a.transpose()};
    }

    /** Unknowns of the plane, two a node, in another order than their places;
     * the last node has one only. */
    TEST(ElementRows, AreTheSumOfWholeAndOfOtherElements)
    {
      const std::vector<int> places = {4, 5, 0, 1, 2, 3, 6};
      constexpr int          n      = 10; // two nodes have no element
      std::vector<Element>   elements;
      for (const std::vector<Index> &unknowns :
           {std::vector<Index>{0, 1, 2, 3}, // whole nodes
            std::vector<Index>{2, 3, 4, 5}, // again
            std::vector<Index>{5, 4, 0, 1}, // components the wrong way round
            std::vector<Index>{1, 6, 3},    // parts of nodes
            std::vector<Index>{4}})
        elements.push_back(element(unknowns));
      Elements all;
      all.for_each = [&](const auto &visit) {
        for (const Element &e : elements)
          visit(e.unknowns, e.matrix.data());
      };
      all.for_each_connection = [&](const auto &visit) {
        for (const Element &e : elements)
          visit(e.unknowns);
      };
      MatrixXd expected = MatrixXd::Zero(n, n);
      for (const Element &e : elements)
        for (std::size_t a = 0; a < e.unknowns.size(); ++a)
          for (std::size_t b = 0; b < e.unknowns.size(); ++b)
            expected(places[static_cast<std::size_t>(e.unknowns[a])],
                     places[static_cast<std::size_t>(e.unknowns[b])]) +=
              e.matrix(static_cast<Index>(a), static_cast<Index>(b));

      const auto rows = rows_of_elements<2>(all, places, 0, n);
      ASSERT_EQ(rows.n_block_rows(), 5u);
      MatrixXd found = MatrixXd::Zero(n, n);
      ASSERT_TRUE(rows.is_upper);
      for (std::size_t i = 0; i < rows.n_block_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          {
            const auto  row    = static_cast<Index>(i);
            const Index column = rows.column[k];
            ASSERT_GE(column, row);
            found.block<2, 2>(2 * column, 2 * row) =
              rows.block(i, k).transpose();
            found.block<2, 2>(2 * row, 2 * column) = rows.block(i, k);
          }
      EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm());
      EXPECT_EQ(found, found.transpose());
      // a diagonal where no element is
      EXPECT_EQ(rows.start[5] - rows.start[4], 1u);
      EXPECT_EQ(rows.column.back(), 4);

      // those of a process with nodes 1 and 2 only, and of one without nodes
      const auto some = rows_of_elements<2>(all, places, 2, 6);
      ASSERT_EQ(some.n_block_rows(), 2u);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = some.start[i]; k < some.start[i + 1]; ++k)
          EXPECT_EQ((some.block(i, k)),
                    (found.block<2, 2>(2 * static_cast<Index>(i) + 2,
                                       2 * some.column[k])));
      EXPECT_EQ(rows_of_elements<2>(all, places, 4, 4).n_block_rows(), 0u);
    }
  } // namespace
} // namespace conetact::iterative
