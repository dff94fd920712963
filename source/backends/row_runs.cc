// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/row_runs.h"

#include <map>
#include <unordered_map>

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

    /** Rows that are alike: fewer are not worth a table of diagonals. */
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
                    const int        *shifts,
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
            x + static_cast<std::ptrdiff_t>(shifts[k]) * block - (block - 1);
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
                 const int        *shifts,
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
            diagonals, shifts, n_columns, x + at * block, y + at * block);
        }
      for (; row < n; row += width)
        {
          const std::size_t at = std::min(row, n - width);
          multiply_strips<block, Number, 1>(
            diagonals, shifts, n_columns, x + at * block, y + at * block);
        }
    }

    template <typename Number>
    using Multiply = void(const Number     *diagonals,
                          const int        *shifts,
                          const std::size_t n_columns,
                          const std::size_t n,
                          const Number     *x,
                          Number           *y);

    // The same for processors that differ in the width of their vectors and in
    // how many of them they have.
    template <int block, typename Number>
    void
    multiply_plain(const Number     *diagonals,
                   const int        *shifts,
                   const std::size_t n_columns,
                   const std::size_t n,
                   const Number     *x,
                   Number           *y)
    {
      multiply_run<block, Number, 1>(diagonals, shifts, n_columns, n, x, y);
    }
#ifdef __x86_64__
    template <int block, typename Number>
    [[gnu::target("avx2,fma")]] void
    multiply_avx2(const Number     *diagonals,
                  const int        *shifts,
                  const std::size_t n_columns,
                  const std::size_t n,
                  const Number     *x,
                  Number           *y)
    {
      multiply_run<block, Number, 1>(diagonals, shifts, n_columns, n, x, y);
    }
    template <int block, typename Number>
    [[gnu::target("avx512f")]] void
    multiply_avx512(const Number     *diagonals,
                    const int        *shifts,
                    const std::size_t n_columns,
                    const std::size_t n,
                    const Number     *x,
                    Number           *y)
    {
      multiply_run<block, Number, 2>(diagonals, shifts, n_columns, n, x, y);
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
  bool
  RowRuns<block, Number>::Run::is_wide() const
  {
    return n >= Wide<Number>::width;
  }



  template <int block, typename Number>
  RowRuns<block, Number>::RowRuns(const Matrix &matrix)
    : A(&matrix)
  {
    if (!matrix.shares_rows())
      return;
    find_runs();
    drop_rare_kinds();
    std::map<Kind, std::size_t> tables;
    for (Run &run : runs)
      {
        if (!run.is_wide())
          continue;
        const auto [table, is_new] =
          tables.emplace(Kind{run.numbers, run.shifts}, diagonals.size());
        if (is_new)
          append_diagonals(run.begin);
        run.diagonals = table->second;
      }
  }



  template <int block, typename Number>
  std::size_t
  RowRuns<block, Number>::n_rows() const
  {
    std::size_t n = 0;
    for (const Run &run : runs)
      if (run.is_wide())
        n += run.n;
    return n;
  }



  template <int block, typename Number>
  const Number *
  RowRuns<block, Number>::numbers_of(const std::size_t row) const
  {
    return A->block(row, A->start[row]).data();
  }



  /* Rows whose numbers many have. What is read beside their columns are numbers
     of x, too. */
  template <int block, typename Number>
  std::vector<bool>
  RowRuns<block, Number>::find_shared() const
  {
    const std::size_t                               n = A->n_block_rows();
    std::unordered_map<const Number *, std::size_t> rows;
    for (std::size_t i = 0; i < n; ++i)
      ++rows[numbers_of(i)];
    const int         last = A->column.empty() ?
                               0 :
                               *std::max_element(A->column.begin(), A->column.end());
    std::vector<bool> is_shared(n);
    for (std::size_t i = 0; i < n; ++i)
      is_shared[i] = A->start[i] < A->start[i + 1] &&
                     A->column[A->start[i]] > 0 &&
                     A->column[A->start[i + 1] - 1] < last &&
                     rows[numbers_of(i)] >= least_rows;
    return is_shared;
  }



  template <int block, typename Number>
  void
  RowRuns<block, Number>::find_runs()
  {
    const std::vector<bool> is_shared = find_shared();
    EqualRows<int>          known;
    std::vector<int>        own;
    for (std::size_t i = 0; i < is_shared.size(); ++i)
      {
        if (!is_shared[i])
          continue;
        own.clear();
        for (std::size_t k = A->start[i]; k < A->start[i + 1]; ++k)
          own.push_back(A->column[k] - static_cast<int>(i));
        const Run run = {i,
                         1,
                         own.size(),
                         numbers_of(i),
                         known.place(own.data(), own.size(), shifts),
                         0};
        if (!runs.empty() && runs.back().begin + runs.back().n == i &&
            runs.back().numbers == run.numbers &&
            runs.back().shifts == run.shifts)
          ++runs.back().n;
        else
          runs.push_back(run);
      }
  }



  template <int block, typename Number>
  void
  RowRuns<block, Number>::drop_rare_kinds()
  {
    std::map<Kind, std::size_t> rows;
    for (const Run &run : runs)
      rows[{run.numbers, run.shifts}] += run.n;
    runs.erase(
      std::remove_if(runs.begin(),
                     runs.end(),
                     [&](const Run &run) {
                       return rows[{run.numbers, run.shifts}] < least_rows;
                     }),
      runs.end());
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
        done                     = run.begin + run.n;
        const int *const columns = shifts.data() + run.shifts;
        if (run.is_wide())
          multiply(diagonals.data() + run.diagonals,
                   columns,
                   run.n_columns,
                   run.n,
                   x + run.begin * block,
                   y + run.begin * block);
        else
          for (std::size_t i = run.begin; i < done; ++i)
            Matrix::multiply_row(run.numbers,
                                 columns,
                                 run.n_columns,
                                 x + i * block,
                                 y + i * block);
      }
    A->multiply(done, A->n_block_rows(), x, y);
  }

  template class RowRuns<2, float>;
  template class RowRuns<2, double>;
  template class RowRuns<3, float>;
  template class RowRuns<3, double>;
} // namespace conetact::backends
