// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_block_products_h
#define conetact_iterative_block_products_h

#include <cstddef>

namespace conetact::iterative
{
  /** Numbers that a processor multiplies at once. */
  template <typename Number, int bytes>
  struct Wide
  {
    typedef Number Vector __attribute__((vector_size(bytes)));
    /** The same anywhere in memory. */
    typedef Number Anywhere
      __attribute__((vector_size(bytes), aligned(sizeof(Number)), may_alias));
    static constexpr std::size_t width = bytes / sizeof(Number);
  };

  /** Rows begin, ..., end - 1 of a sparse matrix of blocks, as BlockMatrix
   * keeps them. */
  template <typename Number>
  struct BlockRows
  {
    /** Blocks of row i are start[i], ..., start[i+1]-1. */
    const std::size_t *start;
    const int         *column; ///< of each block
    /** Where the numbers of row i begin; null: at its first block. */
    const std::size_t *first;
    const Number      *value; ///< blocks, column by column
    std::size_t        begin, end;
  };

  /** Numbers of a column of a block are read in fours: so many at once. */
  constexpr int
  lanes(const int n_rows)
  {
    return (n_rows + 3) / 4 * 4;
  }

  /**
   * Rows of y = A x, in the vectors that the processor has. Behind the last
   * number of A three more may be read.
   */
  template <int n_rows, int n_columns, typename Number>
  void
  multiply_rows(const BlockRows<Number> &A, const Number *x, Number *y);

  /**
   * Adds to y what rows of the upper triangle of a symmetric matrix have: their
   * blocks times x and, of those beside the diagonal, the transposed ones.
   * Each row begins with its diagonal block; none shares its numbers.
   */
  template <int size, typename Number>
  void
  add_upper_rows(const BlockRows<Number> &A, const Number *x, Number *y);

  /** Adds to y = A^T x what these rows of A bring. */
  template <int n_rows, int n_columns, typename Number>
  void
  add_transposed_rows(const BlockRows<Number> &A, const Number *x, Number *y);

  /**
   * The products of one square block with n others, one behind the other, all
   * of them column by column. Behind the factor and the result there must be
   * room for three numbers more.
   */
  template <int size, typename Number>
  void
  multiply_blocks(const Number     *factor,
                  const Number     *blocks,
                  const std::size_t n,
                  Number           *result);
} // namespace conetact::iterative

#endif
