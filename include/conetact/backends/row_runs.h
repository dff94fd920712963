// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_row_runs_h
#define conetact_backends_row_runs_h

#include "conetact/backends/block_matrix.h"

#include <vector>

namespace conetact::backends
{
  /**
   * The product of a matrix in which many rows follow each other with the same
   * numbers and with columns that go on by one from row to row, as those of the
   * nodes along a line of a regular mesh do. All rows of such a run are
   * multiplied at once, in vectors of the width that the processor has; other
   * rows as BlockMatrix does it.
   */
  template <int block, typename Number>
  class RowRuns
  {
  public:
    using Matrix = BlockMatrix<block, block, Number>;

    RowRuns() = default;
    /** The matrix must outlive it. */
    explicit RowRuns(const Matrix &A);

    /** y = A x. */
    void
    operator()(const Number *x, Number *y) const;

    /** In runs. */
    std::size_t
    n_rows() const;

  private:
    /** Rows begin, begin + 1, ... */
    struct Run
    {
      std::size_t begin, n;
      std::size_t numbers; ///< where they begin in `diagonals`
    };
    void
    find_runs();
    void
    append_diagonals(const std::size_t row);

    const Matrix       *A = nullptr;
    std::vector<Run>    runs; ///< ascending
    std::vector<Number> diagonals;
  };

  extern template class RowRuns<2, float>;
  extern template class RowRuns<2, double>;
  extern template class RowRuns<3, float>;
  extern template class RowRuns<3, double>;
} // namespace conetact::backends

#endif
