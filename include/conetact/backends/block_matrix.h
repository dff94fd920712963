// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_block_matrix_h
#define conetact_backends_block_matrix_h

#include <Eigen/Core>

#include <cstddef>
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
    Eigen::Map<const Block>
    block(const std::size_t k) const
    {
      return Eigen::Map<const Block>(value.data() + k * block_size);
    }
    Eigen::Map<Block>
    block(const std::size_t k)
    {
      return Eigen::Map<Block>(value.data() + k * block_size);
    }

    /** y = A x. */
    void
    multiply(const Number *x, Number *y) const
    {
      using Lanes = Eigen::Array<Number, lanes, 1>;
      for (std::size_t i = 0; i + 1 < start.size(); ++i)
        {
          Lanes         sum = Lanes::Zero();
          const Number *a   = value.data() + start[i] * block_size;
          for (std::size_t k = start[i]; k < start[i + 1]; ++k)
            {
              const Number *const in =
                x + static_cast<std::size_t>(column[k]) * n_columns;
              for (int c = 0; c < n_columns; ++c, a += n_rows)
                sum += Eigen::Map<const Lanes>(a) * in[c];
            }
          for (int r = 0; r < n_rows; ++r)
            y[i * n_rows + static_cast<std::size_t>(r)] = sum[r];
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
            result.block(p)     = block(k).transpose();
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
      result.value.assign(value.begin(), value.end());
      return result;
    }

  private:
    static constexpr int lanes = (n_rows + 3) / 4 * 4;
  };
} // namespace conetact::backends

#endif
