// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/row_runs.h"

#include <map>

namespace conetact::backends
{
  namespace
  {
    /** Numbers that are multiplied at once; processors do it in parts. */
    template <typename Number>
    struct Wide
    {
      typedef Number Vector __attribute__((vector_size(64)));
      /** The same anywhere in memory. */
      typedef Number Anywhere
        __attribute__((vector_size(64), aligned(sizeof(Number)), may_alias));
      static constexpr std::size_t width = 64 / sizeof(Number);
    };

    /** Rows that share a table of diagonals: fewer are not worth one. */
    constexpr std::size_t least_rows = 256;

    /**
     * A strip of `block` vectors, that is `width` rows, and `n_strips` of them
     * one behind the other. In a block a_rc = a(r, c), an unknown r of y gets
     * those of x at a distance d = c - r, so that a block is 2 block - 1
     * diagonals, each of which repeats itself after `block` unknowns:
     * y_l += sum_d D_d(l) x_(l+d).
     */
    template <int block, typename Number, int n_strips>
    [[gnu::always_inline]] inline void
    multiply_strips(const Number     *diagonals,
                    const int        *columns,
                    const std::size_t n_columns,
                    const Number     *x,
                    Number           *y)
    {
      using Vector                = typename Wide<Number>::Vector;
      using Anywhere              = typename Wide<Number>::Anywhere;
      constexpr std::size_t width = Wide<Number>::width;
      Vector                sum[n_strips][block] = {};
      for (std::size_t k = 0; k < n_columns; ++k)
        {
          const Number *in =
            x + static_cast<std::ptrdiff_t>(columns[k]) * block - (block - 1);
          for (int d = 0; d < 2 * block - 1; ++d, ++in)
            for (int v = 0; v < block; ++v, diagonals += width)
              {
                const Vector D = *reinterpret_cast<const Anywhere *>(diagonals);
                for (int s = 0; s < n_strips; ++s)
                  sum[s][v] += D * *reinterpret_cast<const Anywhere *>(
                                     in + (s * block + v) * width);
              }
        }
      for (int s = 0; s < n_strips; ++s)
        for (int v = 0; v < block; ++v)
          *reinterpret_cast<Anywhere *>(y + (s * block + v) * width) =
            sum[s][v];
    }

    /** n >= width rows: the last strips overlap. */
    template <int block, typename Number, int most_strips>
    [[gnu::always_inline]] inline void
    multiply_run(const Number     *diagonals,
                 const int        *columns,
                 const std::size_t n_columns,
                 const std::size_t n,
                 const Number     *x,
                 Number           *y)
    {
      constexpr std::size_t width = Wide<Number>::width;
      constexpr std::size_t many  = most_strips * width;
      std::size_t           row   = 0;
      for (; n >= many && row < n; row += many)
        {
          const std::size_t at = std::min(row, n - many);
          multiply_strips<block, Number, most_strips>(
            diagonals, columns, n_columns, x + at * block, y + at * block);
        }
      for (; row < n; row += width)
        {
          const std::size_t at = std::min(row, n - width);
          multiply_strips<block, Number, 1>(
            diagonals, columns, n_columns, x + at * block, y + at * block);
        }
    }

    template <typename Number>
    using Multiply = void(const Number     *diagonals,
                          const int        *columns,
                          const std::size_t n_columns,
                          const std::size_t n,
                          const Number     *x,
                          Number           *y);

    // The same for processors that differ in the width of their vectors and in
    // how many of them they have.
    template <int block, typename Number>
    void
    multiply_plain(const Number     *diagonals,
                   const int        *columns,
                   const std::size_t n_columns,
                   const std::size_t n,
                   const Number     *x,
                   Number           *y)
    {
      multiply_run<block, Number, 1>(diagonals, columns, n_columns, n, x, y);
    }
#ifdef __x86_64__
    template <int block, typename Number>
    [[gnu::target("avx2,fma")]] void
    multiply_avx2(const Number     *diagonals,
                  const int        *columns,
                  const std::size_t n_columns,
                  const std::size_t n,
                  const Number     *x,
                  Number           *y)
    {
      multiply_run<block, Number, 1>(diagonals, columns, n_columns, n, x, y);
    }
    template <int block, typename Number>
    [[gnu::target("avx512f")]] void
    multiply_avx512(const Number     *diagonals,
                    const int        *columns,
                    const std::size_t n_columns,
                    const std::size_t n,
                    const Number     *x,
                    Number           *y)
    {
      multiply_run<block, Number, 2>(diagonals, columns, n_columns, n, x, y);
    }
#endif

    template <int block, typename Number>
    Multiply<Number> *
    choose_multiply()
    {
#ifdef __x86_64__
      if (__builtin_cpu_supports("avx512f"))
        return &multiply_avx512<block, Number>;
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return &multiply_avx2<block, Number>;
#endif
      return &multiply_plain<block, Number>;
    }
  } // namespace



  template <int block, typename Number>
  RowRuns<block, Number>::RowRuns(const Matrix &matrix)
    : A(&matrix)
  {
    if (!matrix.shares_rows())
      return;
    find_runs();
    std::map<const Number *, std::size_t> rows;
    const auto                            numbers = [&](const Run &run) {
      return matrix.block(run.begin, matrix.start[run.begin]).data();
    };
    for (const Run &run : runs)
      rows[numbers(run)] += run.n;
    runs.erase(std::remove_if(runs.begin(),
                              runs.end(),
                              [&](const Run &run) {
                                return rows[numbers(run)] < least_rows;
                              }),
               runs.end());
    std::map<const Number *, std::size_t> tables;
    for (Run &run : runs)
      {
        const auto [table, is_new] =
          tables.emplace(numbers(run), diagonals.size());
        if (is_new)
          append_diagonals(run.begin);
        run.numbers = table->second;
      }
  }



  template <int block, typename Number>
  std::size_t
  RowRuns<block, Number>::n_rows() const
  {
    std::size_t n = 0;
    for (const Run &run : runs)
      n += run.n;
    return n;
  }



  /* What is read beside the columns of a run are numbers of x, too. */
  template <int block, typename Number>
  void
  RowRuns<block, Number>::find_runs()
  {
    const std::size_t n = A->n_block_rows();
    if (n == 0 || A->column.empty())
      return;
    const int  last    = *std::max_element(A->column.begin(), A->column.end());
    const auto goes_on = [&](const std::size_t i) {
      const std::size_t length = A->start[i + 1] - A->start[i];
      if (A->start[i + 2] - A->start[i + 1] != length || length == 0 ||
          A->block(i, A->start[i]).data() !=
            A->block(i + 1, A->start[i + 1]).data())
        return false;
      for (std::size_t k = A->start[i]; k < A->start[i + 1]; ++k)
        if (A->column[k + length] != A->column[k] + 1)
          return false;
      return A->column[A->start[i + 2] - 1] < last;
    };
    for (std::size_t i = 0; i < n;)
      {
        std::size_t end = i + 1;
        if (A->start[i] < A->start[end] && A->column[A->start[i]] > 0)
          while (end < n && goes_on(end - 1))
            ++end;
        if (end - i >= Wide<Number>::width)
          runs.push_back({i, end - i, 0});
        i = end;
      }
  }



  template <int block, typename Number>
  void
  RowRuns<block, Number>::append_diagonals(const std::size_t row)
  {
    constexpr int width = static_cast<int>(Wide<Number>::width);
    for (std::size_t k = A->start[row]; k < A->start[row + 1]; ++k)
      for (int d = 1 - block; d < block; ++d)
        for (int l = 0; l < block * width; ++l)
          {
            const int r = l % block, c = r + d;
            diagonals.push_back(c >= 0 && c < block ? A->block(row, k)(r, c) :
                                                      Number(0));
          }
  }



  template <int block, typename Number>
  void
  RowRuns<block, Number>::operator()(const Number *x, Number *y) const
  {
    static Multiply<Number> *const multiply = choose_multiply<block, Number>();
    std::size_t                    done     = 0;
    for (const Run &run : runs)
      {
        A->multiply(done, run.begin, x, y);
        const std::size_t first = A->start[run.begin];
        multiply(diagonals.data() + run.numbers,
                 A->column.data() + first,
                 A->start[run.begin + 1] - first,
                 run.n,
                 x,
                 y + run.begin * block);
        done = run.begin + run.n;
      }
    A->multiply(done, A->n_block_rows(), x, y);
  }

  template class RowRuns<2, float>;
  template class RowRuns<2, double>;
  template class RowRuns<3, float>;
  template class RowRuns<3, double>;
} // namespace conetact::backends
