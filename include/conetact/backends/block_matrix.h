// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_block_matrix_h
#define conetact_backends_block_matrix_h

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace conetact::backends
{
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

    /** Makes room for the blocks of `start`, all of them zero. */
    void
    allocate()
    {
      column.resize(start.back());
      // Columns are read in fours, up to three numbers too many.
      value.assign(start.back() * block_size + lanes, Number(0));
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

    /**
     * Rows of the same numbers keep them once, such as those of all nodes
     * inside a regular mesh: then they are read from the cache.
     */
    void
    share_equal_rows()
    {
      std::unordered_map<std::string_view, std::size_t> places;
      std::vector<Number>                               once;
      std::vector<std::size_t>                          firsts, unique_rows;
      std::size_t                                       size = 0;
      for (std::size_t i = 0; i < n_block_rows(); ++i)
        {
          const std::size_t length = (start[i + 1] - start[i]) * block_size;
          const std::string_view bytes(reinterpret_cast<const char *>(row(i)),
                                       length * sizeof(Number));
          const auto [known, is_new] = places.emplace(bytes, size);
          firsts.push_back(known->second);
          if (!is_new)
            continue;
          unique_rows.push_back(i);
          size += length;
        }
      once.reserve(size + lanes);
      for (const std::size_t i : unique_rows)
        once.insert(once.end(),
                    row(i),
                    row(i) + (start[i + 1] - start[i]) * block_size);
      once.resize(size + lanes, Number(0));
      value.swap(once);
      first.swap(firsts);
    }

    /** y = A x. */
    void
    multiply(const Number *x, Number *y) const
    {
      using Lanes = Eigen::Array<Number, lanes, 1>;
      for (std::size_t i = 0; i + 1 < start.size(); ++i)
        {
          // a sum for each column of blocks: none waits for another
          Lanes sum[n_columns];
          for (Lanes &s : sum)
            s.setZero();
          const Number *a = row(i);
          for (std::size_t k = start[i]; k < start[i + 1]; ++k)
            {
              const Number *const in =
                x + static_cast<std::size_t>(column[k]) * n_columns;
              for (int c = 0; c < n_columns; ++c, a += n_rows)
                sum[c] += Eigen::Map<const Lanes>(a) * in[c];
            }
          for (int c = 1; c < n_columns; ++c)
            sum[0] += sum[c];
          for (int r = 0; r < n_rows; ++r)
            y[i * n_rows + static_cast<std::size_t>(r)] = sum[0][r];
        }
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

    template <typename Other>
    BlockMatrix<n_rows, n_columns, Other>
    cast() const
    {
      BlockMatrix<n_rows, n_columns, Other> result;
      result.start  = start;
      result.column = column;
      result.first  = first;
      result.value.assign(value.begin(), value.end());
      return result;
    }

  private:
    template <int, int, typename>
    friend class BlockMatrix;

    const Number *
    row(const std::size_t i) const
    {
      return value.data() + (first.empty() ? start[i] * block_size : first[i]);
    }

    std::vector<std::size_t> first; ///< number of each row, if rows share them
    static constexpr int     lanes = (n_rows + 3) / 4 * 4;
  };
} // namespace conetact::backends

#endif
