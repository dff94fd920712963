// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_row_runs_h
#define conetact_iterative_row_runs_h

#include "conetact/iterative/block_matrix.h"

#include <vector>

namespace conetact::iterative
{
  /** Rows begin, begin + 1, ... of a matrix, with the same numbers in columns
   * that go on by one. */
  template <typename Number>
  struct RowRun
  {
    std::size_t   begin, n, n_columns;
    const Number *numbers; ///< of the matrix
    std::size_t   shifts;  ///< where columns less the row begin in a list
  };

  /**
   * The product of a matrix in which many rows have the same numbers in the
   * same columns as counted from their own, as those of the nodes of a regular
   * mesh do. Numbers and columns of such rows are read from the cache; where
   * they follow each other in a run they are multiplied at once, in vectors of
   * the width that the processor has. Other rows as BlockMatrix does it.
   */
  template <int block, typename Number>
  class RowRuns
  {
  public:
    using Matrix = BlockMatrix<block, block, Number>;

    RowRuns() = default;
    /** The matrix must outlive it, and may change in those rows alone that are
     * `changing`. */
    explicit RowRuns(const Matrix &A, const std::vector<int> &changing = {});

    /** y = A x. */
    void
    operator()(const Number *x, Number *y) const;

    /** In runs. */
    std::size_t
    n_rows() const;

  private:
    using Kind    = std::pair<const Number *, std::size_t>;
    using Numbers = std::vector<const Number *>;
    Numbers
    find_equal(const std::vector<int> &changing) const;
    void
    find_runs(const Numbers &numbers);
    void
    drop_rare_kinds();

    const Matrix               *A = nullptr;
    std::vector<RowRun<Number>> runs;   ///< ascending
    std::vector<int>            shifts; ///< columns of a row less the row
    // of a product, not of the matrix
    mutable std::vector<Number>
      parts; ///< first components of x, second ones...
  };

  extern template class RowRuns<2, float>;
  extern template class RowRuns<2, double>;
  extern template class RowRuns<3, float>;
  extern template class RowRuns<3, double>;
  extern template class RowRuns<6, float>;
} // namespace conetact::iterative

#endif
