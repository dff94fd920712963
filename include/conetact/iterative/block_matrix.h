// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_block_matrix_h
#define conetact_iterative_block_matrix_h

#include "conetact/iterative/block_products.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace conetact::iterative
{
  /** Rows of numbers, each of which is kept once. */
  template <typename Number>
  class EqualRows
  {
  public:
    /** Where these numbers are among `all`, at the end of which they go if they
     * are not there yet. */
    std::size_t
    place(const Number *row, const std::size_t length, std::vector<Number> &all)
    {
      const std::size_t      n_bytes = length * sizeof(Number);
      const std::string_view bytes(reinterpret_cast<const char *>(row),
                                   n_bytes);
      const std::size_t      hash = std::hash<std::string_view>()(bytes);
      const auto [begin, end]     = known.equal_range(hash);
      for (auto it = begin; it != end; ++it)
        if (it->second + length <= all.size() &&
            (length == 0 ||
             std::memcmp(all.data() + it->second, row, n_bytes) == 0))
          return it->second;
      const std::size_t at_end = all.size();
      all.insert(all.end(), row, row + length);
      known.emplace(hash, at_end);
      return at_end;
    }

  private:
    std::unordered_multimap<std::size_t, std::size_t> known; ///< places by hash
  };

  /**
   * A sparse matrix of small dense blocks, row by row, such as the stiffness
   * of a mesh, whose nodes have n_rows unknowns each. An index for a whole
   * block and numbers in single precision are what makes its product, which
   * memory limits, three times as fast as that of a matrix of entries.
   */
  template <int n_rows, int n_columns, typename Number>
  class BlockMatrix
  {
  public:
    using Block = Eigen::Matrix<Number, n_rows, n_columns>;
    static constexpr std::size_t block_size =
      static_cast<std::size_t>(n_rows) * n_columns;

    /** Blocks of row i stand at start[i], ..., start[i+1]-1. */
    std::vector<std::size_t> start = {0};
    std::vector<int>         column; ///< ascending in each row
    std::vector<Number>      value;  ///< blocks, column by column
    /** Where the numbers of each row begin, if rows share them; else empty. */
    std::vector<std::size_t> first;
    /** A symmetric matrix may have the blocks from the diagonal on only, which
     * takes half the memory and half the time: rows are read once for both.
     * Where rows share their numbers there is nothing to gain. */
    bool is_upper = false;

    /** Makes room for the blocks of `start`, all of them zero. */
    void
    allocate()
    {
      column.resize(start.back());
      // Columns are read in fours, up to three numbers too many.
      value.assign(start.back() * block_size + lanes(n_rows), Number(0));
    }
    std::size_t
    n_block_rows() const
    {
      return start.size() - 1;
    }
    /** Number k of all blocks, which is in row i. */
    Eigen::Map<const Block>
    block(const std::size_t i, const std::size_t k) const
    {
      return Eigen::Map<const Block>(row(i) + (k - start[i]) * block_size);
    }
    /** The same while no row shares its blocks with others. */
    Eigen::Map<Block>
    block(const std::size_t k)
    {
      return Eigen::Map<Block>(value.data() + k * block_size);
    }
    Eigen::Map<Block>
    block(const std::size_t, const std::size_t k)
    {
      return block(k);
    }

    /** y = A x. */
    void
    multiply(const Number *x, Number *y) const
    {
      if constexpr (n_rows == n_columns && n_rows < 4)
        if (is_upper)
          {
            std::fill_n(y, n_block_rows() * n_rows, Number(0));
            return add_upper_rows<n_rows>(rows(0, n_block_rows()), x, y);
          }
      multiply(0, n_block_rows(), x, y);
    }
    /** y = A x, where y is zero and A has no blocks but in some rows that meets
     * a node of x which is not zero. */
    void
    multiply_some(const std::vector<std::size_t> &some,
                  const Number                   *x,
                  Number                         *y) const
    {
      for (const std::size_t i : some)
        if (is_upper)
          add_upper_rows<n_rows>(rows(i, i + 1), x, y);
        else
          multiply(i, i + 1, x, y);
    }
    /** y += A^T x. */
    void
    add_transposed(const Number *x, Number *y) const
    {
      add_transposed_rows<n_rows, n_columns>(rows(0, n_block_rows()), x, y);
    }
    /** Rows begin, ..., end - 1 of it, which are whole. */
    void
    multiply(const std::size_t begin,
             const std::size_t end,
             const Number     *x,
             Number           *y) const
    {
      multiply_rows<n_rows, n_columns>(rows(begin, end), x, y);
    }

    BlockMatrix<n_columns, n_rows, Number>
    transposed(const std::size_t n_block_columns) const
    {
      BlockMatrix<n_columns, n_rows, Number> result;
      result.start.assign(n_block_columns + 1, 0);
      for (const int j : column)
        ++result.start[static_cast<std::size_t>(j) + 1];
      for (std::size_t j = 0; j < n_block_columns; ++j)
        result.start[j + 1] += result.start[j];
      result.allocate();
      std::vector<std::size_t> next = result.start;
      for (std::size_t i = 0; i < n_block_rows(); ++i)
        for (std::size_t k = start[i]; k < start[i + 1]; ++k)
          {
            const std::size_t p = next[static_cast<std::size_t>(column[k])]++;
            result.column[p]    = static_cast<int>(i);
            result.block(p)     = block(i, k).transpose();
          }
      return result;
    }

    /** Whether rows of the same numbers keep them once. */
    bool
    shares_rows() const
    {
      return !first.empty();
    }

    template <typename Other>
    BlockMatrix<n_rows, n_columns, Other>
    cast() const
    {
      BlockMatrix<n_rows, n_columns, Other> result;
      result.start    = start;
      result.column   = column;
      result.first    = first;
      result.is_upper = is_upper;
      result.value.assign(value.begin(), value.end());
      return result;
    }

  private:
    BlockRows<Number>
    rows(const std::size_t begin, const std::size_t end) const
    {
      return {start.data(),
              column.data(),
              first.empty() ? nullptr : first.data(),
              value.data(),
              begin,
              end};
    }
    const Number *
    row(const std::size_t i) const
    {
      return value.data() + (first.empty() ? start[i] * block_size : first[i]);
    }
  };

  /** Columns of a row in the order in which they come, and their blocks. */
  template <int n_rows, int n_columns>
  struct GrowingRow
  {
    using Block = Eigen::Matrix<double, n_rows, n_columns>;
    std::vector<int>   column;
    std::vector<Block> block;

    /** Number of the block of a column, which is there then. */
    std::size_t
    find(const int j)
    {
      const auto k = static_cast<std::size_t>(
        std::find(column.begin(), column.end(), j) - column.begin());
      if (k == column.size())
        {
          column.push_back(j);
          block.push_back(Block::Zero());
        }
      return k;
    }
    Block &
    operator[](const int j)
    {
      return block[find(j)];
    }
    void
    clear()
    {
      column.clear();
      block.clear();
    }
    /** Appends them in ascending order; blocks column by column. */
    template <typename Number>
    void
    append_to(std::vector<int> &columns, std::vector<Number> &numbers) const
    {
      std::vector<std::size_t> order(column.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
        return column[a] < column[b];
      });
      for (const std::size_t k : order)
        {
          columns.push_back(column[k]);
          const Eigen::Matrix<Number, n_rows, n_columns> cast =
            block[k].template cast<Number>();
          numbers.insert(numbers.end(), cast.data(), cast.data() + cast.size());
        }
    }
  };

  /**
   * Puts a matrix together row by row. Where rows share their numbers those of
   * the same numbers keep them once, such as all nodes inside a regular mesh:
   * they are read from the cache.
   */
  template <int n_rows, int n_columns, typename Number>
  class RowByRow
  {
  public:
    using Matrix = BlockMatrix<n_rows, n_columns, Number>;

    explicit RowByRow(const bool are_shared)
      : share(are_shared)
    {}

    /** Room for so many blocks, if no rows share theirs. */
    void
    reserve(const std::size_t n)
    {
      A.column.reserve(n);
      if (!share)
        A.value.reserve(n * Matrix::block_size + lanes(n_rows));
    }
    /** Columns ascend, as many as there are blocks; `numbers` are these. */
    void
    append(const int                 *columns,
           const std::size_t          n,
           const std::vector<Number> &numbers)
    {
      if (share)
        A.first.push_back(rows.place(numbers.data(), numbers.size(), A.value));
      else
        A.value.insert(A.value.end(), numbers.begin(), numbers.end());
      A.column.insert(A.column.end(), columns, columns + n);
      A.start.push_back(A.column.size());
    }

    Matrix
    finish()
    {
      A.value.resize(A.value.size() + lanes(n_rows), Number(0));
      rows = {};
      return std::move(A);
    }

  private:
    const bool        share;
    Matrix            A;
    EqualRows<Number> rows;
  };

  /** The same matrix, with equal rows kept once if most are like others. */
  template <int n_rows, int n_columns, typename Number>
  BlockMatrix<n_rows, n_columns, Number>
  with_equal_rows(BlockMatrix<n_rows, n_columns, Number> A)
  {
    // Counted before any is kept: most matrices have few.
    std::unordered_map<std::string_view, std::size_t> places;
    std::vector<std::size_t>                          first;
    std::size_t                                       n_numbers = 0;
    for (std::size_t i = 0; i < A.n_block_rows(); ++i)
      {
        const std::size_t      n = (A.start[i + 1] - A.start[i]) * A.block_size;
        const std::string_view row(reinterpret_cast<const char *>(
                                     A.value.data() +
                                     A.start[i] * A.block_size),
                                   n * sizeof(Number));
        const auto [found, is_new] = places.emplace(row, n_numbers);
        if (is_new)
          n_numbers += n;
        if (2 * n_numbers > A.value.size())
          return A;
        first.push_back(found->second);
      }
    std::vector<Number> value;
    value.reserve(n_numbers + lanes(n_rows));
    for (std::size_t i = 0; i < A.n_block_rows(); ++i)
      if (first[i] == value.size())
        value.insert(value.end(),
                     A.value.data() + A.start[i] * A.block_size,
                     A.value.data() + A.start[i + 1] * A.block_size);
    value.resize(n_numbers + lanes(n_rows), Number(0));
    A.value = std::move(value);
    A.first = std::move(first);
    return A;
  }
} // namespace conetact::iterative

#endif
