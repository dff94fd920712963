// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_smoothed_aggregation_h
#define conetact_backends_smoothed_aggregation_h

#include "conetact/base/communicator.h"

#include <Eigen/Dense>

#include <functional>
#include <memory>
#include <vector>

namespace conetact::backends
{
  /** Entries of a row of a sparse matrix. */
  struct SparseRow
  {
    std::vector<int>    columns;
    std::vector<double> values;
  };

  /**
   * Coarse levels of a symmetric positive definite matrix by Trilinos' ML:
   * nodes are put together to aggregates, whose motions are those of the
   * `modes` (rigid ones), smoothed by one step of Jacobi's method (Vanek,
   * Mandel, Brezina, Computing 56 (1996) 179-196). Level 0 is the matrix
   * itself. An aggregate has as many unknowns, one behind the other, as there
   * are modes.
   *
   * Each process has rows of all levels, and makes aggregates of its own nodes.
   */
  class SmoothedAggregation
  {
  public:
    /**
     * Process p has rows first[p], ..., first[p+1]-1 of the matrix, with
     * `block` unknowns a node; `row_of` counts its own rows and the columns of
     * all. Entries that are zero join nodes, too. `modes` has a column for
     * each, and the rows of this process.
     */
    SmoothedAggregation(
      const std::vector<int>                                &first,
      const int                                              block,
      const std::function<void(const int row, SparseRow &)> &row_of,
      const Eigen::MatrixXd                                 &modes,
      const Communicator                                    &processes);
    ~SmoothedAggregation();
    SmoothedAggregation(const SmoothedAggregation &) = delete;
    SmoothedAggregation &
    operator=(const SmoothedAggregation &) = delete;

    /** With the finest. */
    int
    n_levels() const;
    /** Unknowns of a level: process p has first[p], ..., first[p+1]-1. */
    const std::vector<int> &
    first(const int level) const;
    /** Those of this process. */
    int
    size(const int level) const;
    /** Of the matrix of a level, but the finest; rows as `row_of` counts. */
    void
    matrix_row(const int level, const int row, SparseRow &result) const;
    /** Of the map from a level to the one above it, which is finer. */
    void
    prolongator_row(const int level, const int row, SparseRow &result) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace conetact::backends

#endif
