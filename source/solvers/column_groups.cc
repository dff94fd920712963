// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/column_groups.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;

    /** Sets of columns that are joined two by two. */
    class JoinedColumns
    {
    public:
      explicit JoinedColumns(const Index n)
        : above(static_cast<std::size_t>(n))
      {
        std::iota(above.begin(), above.end(), Index{0});
      }
      /** The least column of its set. */
      Index
      least(Index j)
      {
        while (parent(j) != j)
          j = parent(j) = parent(parent(j));
        return j;
      }
      void
      join(const Index i, const Index j)
      {
        const Index a = least(i), b = least(j);
        parent(std::max(a, b)) = std::min(a, b);
      }

    private:
      Index &
      parent(const Index j)
      {
        return above[static_cast<std::size_t>(j)];
      }
      std::vector<Index> above;
    };

    /** The columns that are not zero in a block of rows, for each block. */
    std::vector<std::vector<Index>>
    columns_in_blocks(const Eigen::MatrixXd    &matrix,
                      const std::vector<Index> &first)
    {
      std::vector<std::vector<Index>> columns(first.size() - 1);
      for (Index j = 0; j < matrix.cols(); ++j)
        for (std::size_t i = 0; i < columns.size(); ++i)
          if (!matrix.col(j)
                 .segment(first[i], first[i + 1] - first[i])
                 .isZero(0))
            columns[i].push_back(j);
      return columns;
    }
  } // namespace

  std::vector<ColumnGroup>
  column_groups(const Eigen::MatrixXd &matrix, const std::vector<Index> &first)
  {
    eigen_assert(!first.empty() && first.back() <= matrix.rows());
    const auto    columns = columns_in_blocks(matrix, first);
    JoinedColumns joined(matrix.cols());
    for (const std::vector<Index> &together : columns)
      for (const Index j : together)
        joined.join(together[0], j);
    std::map<Index, ColumnGroup> groups; // by their first columns
    for (Index j = 0; j < matrix.cols(); ++j)
      groups[joined.least(j)].columns.push_back(j);
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (!columns[i].empty())
        groups[joined.least(columns[i][0])].blocks.push_back(
          static_cast<Index>(i));
    std::vector<ColumnGroup> result;
    for (auto &[column, group] : groups)
      result.push_back(std::move(group));
    return result;
  }

  std::vector<Index>
  nodes_of(const ContactSystem &system)
  {
    return {system.first.begin(), system.first.begin() + system.n_nodes() + 1};
  }

  std::vector<ColumnGroup>
  column_groups(const Eigen::MatrixXd &matrix)
  {
    std::vector<Index> rows(static_cast<std::size_t>(matrix.rows()) + 1);
    std::iota(rows.begin(), rows.end(), Index{0});
    return column_groups(matrix, rows);
  }
} // namespace conetact::solvers
