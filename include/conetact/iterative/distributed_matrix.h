// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_distributed_matrix_h
#define conetact_iterative_distributed_matrix_h

#include "conetact/iterative/block_matrix.h"
#include "conetact/iterative/halo.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace conetact::iterative
{
  /** Adds to rows of a vector: y_rows[i] += (A x)_i. */
  template <int n_rows, int n_columns, typename Number>
  void
  add_rows(const BlockMatrix<n_rows, n_columns, Number> &A,
           const std::vector<int>                       &rows,
           const Number                                 *x,
           std::vector<Number>                          &buffer,
           Number                                       *y)
  {
    buffer.resize(rows.size() * n_rows);
    A.multiply(x, buffer.data());
    const Number *from = buffer.data();
    for (const int i : rows)
      for (int r = 0; r < n_rows; ++r)
        y[static_cast<std::ptrdiff_t>(i) * n_rows + r] += *from++;
  }

  /** Blocks left of the diagonal that a matrix has as transposed ones of other
   * rows: those of row i are start[i], ..., start[i+1]-1. */
  struct LowerBlocks
  {
    std::vector<std::size_t> start = {0};
    std::vector<std::size_t> block; ///< among all of the matrix
    std::vector<int>         row;   ///< that has it
  };

  /**
   * The rows of a matrix that this process has: columns whose unknowns it has,
   * too, and those of others, which are sent while it multiplies its own. A
   * process that is alone has a BlockMatrix, no more.
   */
  template <int n_rows, int n_columns, typename Number>
  class DistributedMatrix
  {
  public:
    using Matrix = BlockMatrix<n_rows, n_columns, Number>;

    DistributedMatrix() = default;
    /**
     * `rows` number columns among those of all processes, of which process p
     * has first[p], ..., first[p+1]-1. All processes call this.
     */
    DistributedMatrix(Matrix                  rows,
                      const std::vector<int> &first,
                      const Communicator     &processes)
    {
      if (processes.size() == 1)
        {
          own           = std::move(rows);
          n_own_columns = first.back();
          find_lower();
          return;
        }
      begin         = first[static_cast<std::size_t>(processes.rank())];
      const int end = first[static_cast<std::size_t>(processes.rank()) + 1];
      n_own_columns = end - begin;
      for (const int j : rows.column)
        if (j < begin || j >= end)
          needed.push_back(j);
      std::sort(needed.begin(), needed.end());
      needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
      split(rows, end);
      halo = Halo<n_columns, Number>(
        std::make_shared<const HaloPlan>(needed, first, processes));
      find_lower();
    }

    /** Not of a process that is alone. */
    const HaloPlan &
    halo_plan() const
    {
      return *halo.its_plan();
    }
    /** Of own rows and columns. */
    const Matrix &
    own_part() const
    {
      return own;
    }

    /** y = A x, of vectors of which each process has its part. */
    void
    multiply(const Number *x, Number *y) const
    {
      multiply(x, y, [&](const Number *in, Number *out) {
        own.multiply(in, out);
      });
    }
    /** The same with another product of the own part. */
    template <typename Product>
    void
    multiply(const Number *x, Number *y, const Product &product_of_own) const
    {
      if (halo.its_plan() == nullptr)
        return product_of_own(x, y);
      halo.start(x);
      product_of_own(x, y);
      add_rows(far, edge, halo.finish(), buffer, y);
    }

    template <typename Other>
    DistributedMatrix<n_rows, n_columns, Other>
    cast() const
    {
      DistributedMatrix<n_rows, n_columns, Other> result;
      result.own           = own.template cast<Other>();
      result.far           = far.template cast<Other>();
      result.edge          = edge;
      result.begin         = begin;
      result.n_own_columns = n_own_columns;
      result.needed        = needed;
      result.lower         = lower;
      if (halo.its_plan() != nullptr)
        result.halo = Halo<n_columns, Other>(halo.its_plan());
      return result;
    }

    /** Calls f with the numbers of all blocks. */
    template <typename F>
    void
    for_all_numbers(const F &f)
    {
      for (Number &a : own.value)
        f(a);
      for (Number &a : far.value)
        f(a);
    }

    /** Calls f(column, block) for a row: own columns before those of others.
     * Not once rows are forgotten. */
    template <typename F>
    void
    for_row(const std::size_t i, const F &f) const
    {
      for_row_of(*this, i, f);
    }
    /** The same with blocks that f may change, while no rows share them. */
    template <typename F>
    void
    for_row(const std::size_t i, const F &f)
    {
      for_row_of(*this, i, f);
    }

    /** From here on it is multiplied only: what for_row() needs of a matrix
     * that has its upper triangle goes. */
    void
    forget_rows()
    {
      lower.reset();
    }

    /** Of a column that for_row() names, among those of all processes. */
    int
    number_of_column(const int column) const
    {
      return column < n_own_columns ?
               begin + column :
               needed[static_cast<std::size_t>(column - n_own_columns)];
    }

  private:
    template <int, int, typename>
    friend class DistributedMatrix;
    template <int, int, typename>
    friend class TransposedMatrix;

    void
    find_lower()
    {
      if (!own.is_upper)
        return;
      const std::size_t n      = own.n_block_rows();
      auto              blocks = std::make_shared<LowerBlocks>();
      blocks->start.assign(n + 1, 0);
      const auto for_each = [&](const auto &visit) {
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t k = own.start[i] + 1; k < own.start[i + 1]; ++k)
            visit(i, k, static_cast<std::size_t>(own.column[k]));
      };
      for_each([&](const std::size_t, const std::size_t, const std::size_t j) {
        ++blocks->start[j + 1];
      });
      std::partial_sum(blocks->start.begin(),
                       blocks->start.end(),
                       blocks->start.begin());
      blocks->block.resize(blocks->start.back());
      blocks->row.resize(blocks->start.back());
      std::vector<std::size_t> next = blocks->start;
      for_each([&](const std::size_t i, const std::size_t k, const auto j) {
        blocks->block[next[j]] = k;
        blocks->row[next[j]++] = static_cast<int>(i);
      });
      lower = std::move(blocks);
    }

    template <typename Self, typename F>
    static void
    for_row_of(Self &self, const std::size_t i, const F &f)
    {
      Assert(!self.own.is_upper || self.lower,
             dealii::ExcMessage("Rows have been forgotten."));
      if constexpr (n_rows == n_columns)
        if (self.lower)
          for (std::size_t k = self.lower->start[i];
               k < self.lower->start[i + 1];
               ++k)
            {
              const int                    j = self.lower->row[k];
              const typename Matrix::Block block =
                std::as_const(self.own)
                  .block(static_cast<std::size_t>(j), self.lower->block[k])
                  .transpose();
              f(j, block);
            }
      for (std::size_t k = self.own.start[i]; k < self.own.start[i + 1]; ++k)
        f(self.own.column[k], self.own.block(i, k));
      const std::vector<int> &edge = self.edge;
      const auto              it =
        std::lower_bound(edge.begin(), edge.end(), static_cast<int>(i));
      if (it == edge.end() || *it != static_cast<int>(i))
        return;
      const auto e = static_cast<std::size_t>(it - edge.begin());
      for (std::size_t k = self.far.start[e]; k < self.far.start[e + 1]; ++k)
        f(self.n_own_columns + self.far.column[k], self.far.block(e, k));
    }

    /** Parts of rows that share their numbers share theirs. */
    void
    split(const Matrix &rows, const int end)
    {
      RowByRow<n_rows, n_columns, Number> own_rows(rows.shares_rows()),
        far_rows(rows.shares_rows());
      const auto n_far = static_cast<std::size_t>(
        std::count_if(rows.column.begin(), rows.column.end(), [&](const int j) {
          return j < begin || j >= end;
        }));
      own_rows.reserve(rows.column.size() - n_far);
      far_rows.reserve(n_far);
      std::vector<int>    own_columns, far_columns;
      std::vector<Number> own_numbers, far_numbers;
      for (std::size_t i = 0; i < rows.n_block_rows(); ++i)
        {
          own_columns.clear();
          far_columns.clear();
          own_numbers.clear();
          far_numbers.clear();
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
            {
              const int  j      = rows.column[k];
              const bool is_own = j >= begin && j < end;
              const auto block  = rows.block(i, k);
              (is_own ? own_columns : far_columns)
                .push_back(is_own ? j - begin : place_of(j));
              auto &numbers = is_own ? own_numbers : far_numbers;
              numbers.insert(numbers.end(),
                             block.data(),
                             block.data() + block.size());
            }
          own_rows.append(own_columns.data(), own_columns.size(), own_numbers);
          if (far_columns.empty())
            continue;
          edge.push_back(static_cast<int>(i));
          far_rows.append(far_columns.data(), far_columns.size(), far_numbers);
        }
      own          = own_rows.finish();
      own.is_upper = rows.is_upper;
      far          = far_rows.finish();
    }

    /** Of a column of others. */
    int
    place_of(const int j) const
    {
      return static_cast<int>(
        std::lower_bound(needed.begin(), needed.end(), j) - needed.begin());
    }

    Matrix           own;
    Matrix           far;  ///< of rows `edge` and columns of others
    std::vector<int> edge; ///< rows that see others
    int              begin = 0, n_own_columns = 0;
    std::vector<int> needed;                  ///< columns of others
    std::shared_ptr<const LowerBlocks> lower; ///< of an upper triangle
    // of a product, not of the matrix
    mutable Halo<n_columns, Number> halo;
    mutable std::vector<Number>     buffer;
  };

  /** The transposed of a DistributedMatrix, whose rows have the same owners as
   * its columns. */
  template <int n_rows, int n_columns, typename Number>
  class TransposedMatrix
  {
  public:
    TransposedMatrix() = default;
    /** A must outlive it. Where its rows share their numbers, those of the
     * transposed one do, too, and are kept; else A serves. */
    TransposedMatrix(const DistributedMatrix<n_columns, n_rows, Number> &A,
                     const std::size_t                                   n_own)
      : n_rows_own(n_own)
      , edge(A.edge)
    {
      if (A.own.shares_rows())
        own = with_equal_rows(A.own.transposed(n_own));
      else
        given = &A.own;
      if (A.halo.its_plan() == nullptr)
        return;
      halo = Halo<n_rows, Number>(A.halo.its_plan());
      far =
        A.far.transposed(static_cast<std::size_t>(A.halo.its_plan()->n_needed));
    }

    /** y = A^T x. */
    void
    multiply(const Number *x, Number *y) const
    {
      if (halo.its_plan() == nullptr)
        return multiply_own(x, y);
      buffer.resize(edge.size() * n_columns);
      Number *to = buffer.data();
      for (const int i : edge)
        for (int c = 0; c < n_columns; ++c)
          *to++ = x[static_cast<std::ptrdiff_t>(i) * n_columns + c];
      far.multiply(buffer.data(), halo.far_blocks());
      halo.start_back();
      multiply_own(x, y);
      halo.finish_back(y);
    }

  private:
    void
    multiply_own(const Number *x, Number *y) const
    {
      if (given == nullptr)
        return own.multiply(x, y);
      std::fill_n(y, n_rows_own * n_rows, Number(0));
      given->add_transposed(x, y);
    }

    std::size_t n_rows_own = 0;
    /** Where no rows are shared. */
    const BlockMatrix<n_columns, n_rows, Number> *given = nullptr;
    BlockMatrix<n_rows, n_columns, Number>        own; ///< else
    BlockMatrix<n_rows, n_columns, Number> far; ///< from `edge` to others
    std::vector<int>                       edge;
    mutable Halo<n_rows, Number>           halo;
    mutable std::vector<Number>            buffer;
  };
} // namespace conetact::iterative

#endif
