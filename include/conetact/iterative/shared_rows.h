// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_shared_rows_h
#define conetact_iterative_shared_rows_h

#include "conetact/iterative/distributed_matrix.h"

#include <algorithm>
#include <utility>

namespace conetact::iterative
{
  /** The rows of all processes, one behind the other. */
  template <int n_rows, int n_columns, typename Number>
  BlockMatrix<n_rows, n_columns, Number>
  gather_rows(BlockMatrix<n_rows, n_columns, Number> own,
              const Communicator                    &processes)
  {
    if (processes.size() == 1)
      return own;
    using Ints    = Eigen::VectorXi;
    using Numbers = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    const auto n  = static_cast<Eigen::Index>(own.column.size());
    Ints       lengths(static_cast<Eigen::Index>(own.n_block_rows()));
    for (std::size_t i = 0; i < own.n_block_rows(); ++i)
      lengths[static_cast<Eigen::Index>(i)] =
        static_cast<int>(own.start[i + 1] - own.start[i]);
    BlockMatrix<n_rows, n_columns, Number> all;
    for (const int length : processes.gather_all(lengths))
      all.start.push_back(all.start.back() + static_cast<std::size_t>(length));
    all.allocate();
    const Ints columns =
      processes.gather_all(Ints(Eigen::Map<Ints>(own.column.data(), n)));
    std::copy(columns.begin(), columns.end(), all.column.begin());
    const Numbers values = processes.gather_all(
      Numbers(Eigen::Map<Numbers>(own.value.data(), n * n_rows * n_columns)));
    std::copy(values.begin(), values.end(), all.value.begin());
    return all;
  }

  /** Ascending lists of all processes, in one. */
  inline std::vector<int>
  gather_numbers(const std::vector<int> &own, const Communicator &processes)
  {
    const Eigen::VectorXi all =
      processes.gather_all(Eigen::VectorXi(Eigen::Map<const Eigen::VectorXi>(
        own.data(), static_cast<Eigen::Index>(own.size()))));
    std::vector<int> result(all.begin(), all.end());
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /** Some rows of a matrix; columns are those of all processes. */
  template <int n_rows, int n_columns>
  struct SomeRows
  {
    using Pattern = std::vector<std::pair<int, int>>;

    std::vector<int>                      number; ///< ascending
    BlockMatrix<n_rows, n_columns, float> blocks;

    SomeRows() = default;
    /** Zero, with the blocks (row, column) of a list in ascending order. */
    explicit SomeRows(const Pattern &pattern)
    {
      for (const auto &[i, j] : pattern)
        {
          if (number.empty() || number.back() != i)
            {
              number.push_back(i);
              blocks.start.push_back(blocks.start.back());
            }
          ++blocks.start.back();
        }
      blocks.allocate();
      for (std::size_t k = 0; k < pattern.size(); ++k)
        blocks.column[k] = pattern[k].second;
    }
    /** Those `wanted` of a matrix whose rows of this process begin at `begin`:
     * each process gets all of them. */
    SomeRows(const DistributedMatrix<n_rows, n_columns, float> &A,
             const std::vector<int>                            &wanted,
             const int                                          begin,
             const Communicator                                &processes)
      : number(wanted)
    {
      const int n = static_cast<int>(A.own_part().n_block_rows());
      BlockMatrix<n_rows, n_columns, float>                                own;
      std::vector<std::pair<int, Eigen::Matrix<float, n_rows, n_columns>>> row;
      for (const int i : wanted)
        {
          if (i < begin || i >= begin + n)
            continue;
          row.clear();
          A.for_row(static_cast<std::size_t>(i - begin),
                    [&](const int column, const auto &block) {
                      row.emplace_back(A.number_of_column(column), block);
                    });
          std::sort(row.begin(), row.end(), [](const auto &a, const auto &b) {
            return a.first < b.first;
          });
          for (const auto &[column, block] : row)
            {
              own.column.push_back(column);
              own.value.insert(own.value.end(),
                               block.data(),
                               block.data() + block.size());
            }
          own.start.push_back(own.column.size());
        }
      blocks = gather_rows(std::move(own), processes);
    }

    /** Where a row stands, which must be one of them. */
    std::size_t
    find(const int i) const
    {
      return static_cast<std::size_t>(
        std::lower_bound(number.begin(), number.end(), i) - number.begin());
    }
    /** Calls f(column, block) for the row that stands at i. */
    template <typename F>
    void
    for_row(const std::size_t i, const F &f) const
    {
      for (std::size_t k = blocks.start[i]; k < blocks.start[i + 1]; ++k)
        f(blocks.column[k], blocks.block(i, k));
    }
    /** Number of the block in a column of that row, which must be there. */
    std::size_t
    find(const std::size_t i, const int column) const
    {
      const auto first = blocks.column.begin();
      return static_cast<std::size_t>(
        std::lower_bound(first + static_cast<std::ptrdiff_t>(blocks.start[i]),
                         first +
                           static_cast<std::ptrdiff_t>(blocks.start[i + 1]),
                         column) -
        first);
    }
  };
} // namespace conetact::iterative

#endif
