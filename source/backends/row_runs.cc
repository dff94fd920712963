// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/row_runs.h"

#include <map>
#include <unordered_map>
#include <unordered_set>

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

    /** Rows that are alike: fewer are not worth a place in the cache. */
    constexpr std::size_t least_rows = 256;

    /** Rows of a matrix that are alike, and the vector that it multiplies:
     * first components of all blocks, then the second ones, and so on. */
    template <typename Number>
    struct Alike
    {
      const Number *numbers;
      const int    *shifts;
      std::size_t   n_columns;
      const Number *parts;
      std::size_t   n_parts; ///< length of each of them
    };

    /** A strip of `width` rows, and `n_strips` of them one behind the other,
     * beginning with `row`. */
    template <int block, typename Number, int n_strips>
    [[gnu::always_inline]] inline void
    multiply_strips(const Alike<Number> &rows, const std::size_t row, Number *y)
    {
      using Vector                = typename Wide<Number>::Vector;
      using Anywhere              = typename Wide<Number>::Anywhere;
      constexpr std::size_t width = Wide<Number>::width;
      Vector                sum[block][n_strips] = {};
      const Number         *a                    = rows.numbers;
      for (std::size_t k = 0; k < rows.n_columns; ++k)
        {
          const Number *in = rows.parts + row + rows.shifts[k];
          for (int c = 0; c < block; ++c, in += rows.n_parts)
            for (int r = 0; r < block; ++r, ++a)
              for (int s = 0; s < n_strips; ++s)
                sum[r][s] +=
                  *a * *reinterpret_cast<const Anywhere *>(in + s * width);
        }
      alignas(64) Number out[block][n_strips * width];
      for (int r = 0; r < block; ++r)
        for (int s = 0; s < n_strips; ++s)
          *reinterpret_cast<Anywhere *>(out[r] + s * width) = sum[r][s];
      y += row * block;
      for (std::size_t l = 0; l < n_strips * width; ++l)
        for (int r = 0; r < block; ++r)
          *y++ = out[r][l];
    }

    /** n >= width rows: the last strips overlap. */
    template <int block, typename Number, int most_strips>
    [[gnu::always_inline]] inline void
    multiply_run(const Alike<Number> &rows,
                 const std::size_t    begin,
                 const std::size_t    n,
                 Number              *y)
    {
      constexpr std::size_t width = Wide<Number>::width;
      constexpr std::size_t many  = most_strips * width;
      std::size_t           row   = 0;
      for (; n >= many && row < n; row += many)
        multiply_strips<block, Number, most_strips>(
          rows, begin + std::min(row, n - many), y);
      for (; row < n; row += width)
        multiply_strips<block, Number, 1>(rows,
                                          begin + std::min(row, n - width),
                                          y);
    }

    template <int block, typename Number>
    [[gnu::always_inline]] inline void
    take_apart(const Number *x, const std::size_t n, Number *parts)
    {
      for (std::size_t i = 0; i < n; ++i)
        for (int c = 0; c < block; ++c)
          parts[static_cast<std::size_t>(c) * n + i] = *x++;
    }

    template <typename Number>
    struct Kernels
    {
      void (*multiply)(const Alike<Number> &rows,
                       const std::size_t    begin,
                       const std::size_t    n,
                       Number              *y);
      void (*take_apart)(const Number *x, const std::size_t n, Number *parts);
    };

    // The same for processors that differ in the width of their vectors and in
    // how many of them they have.
    template <int block, typename Number>
    struct Plain
    {
      static void
      multiply(const Alike<Number> &rows,
               const std::size_t    begin,
               const std::size_t    n,
               Number              *y)
      {
        multiply_run<block, Number, 1>(rows, begin, n, y);
      }
      static void
      split(const Number *x, const std::size_t n, Number *parts)
      {
        take_apart<block>(x, n, parts);
      }
    };
#ifdef __x86_64__
    template <int block, typename Number>
    struct Avx2
    {
      [[gnu::target("avx2,fma")]] static void
      multiply(const Alike<Number> &rows,
               const std::size_t    begin,
               const std::size_t    n,
               Number              *y)
      {
        multiply_run<block, Number, 1>(rows, begin, n, y);
      }
      [[gnu::target("avx2,fma")]] static void
      split(const Number *x, const std::size_t n, Number *parts)
      {
        take_apart<block>(x, n, parts);
      }
    };
    template <int block, typename Number>
    struct Avx512
    {
      [[gnu::target("avx512f,prefer-vector-width=512")]] static void
      multiply(const Alike<Number> &rows,
               const std::size_t    begin,
               const std::size_t    n,
               Number              *y)
      {
        multiply_run<block, Number, 2>(rows, begin, n, y);
      }
      [[gnu::target("avx512f,prefer-vector-width=512")]] static void
      split(const Number *x, const std::size_t n, Number *parts)
      {
        take_apart<block>(x, n, parts);
      }
    };
#endif

    template <int block, typename Number>
    Kernels<Number>
    choose_kernels()
    {
#ifdef __x86_64__
      if (__builtin_cpu_supports("avx512f"))
        return {&Avx512<block, Number>::multiply,
                &Avx512<block, Number>::split};
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return {&Avx2<block, Number>::multiply, &Avx2<block, Number>::split};
#endif
      return {&Plain<block, Number>::multiply, &Plain<block, Number>::split};
    }
  } // namespace



  template <int block, typename Number>
  bool
  RowRuns<block, Number>::Run::is_wide() const
  {
    return n >= Wide<Number>::width;
  }



  template <int block, typename Number>
  RowRuns<block, Number>::RowRuns(const Matrix           &matrix,
                                  const std::vector<int> &changing)
    : A(&matrix)
  {
    find_runs(find_equal(changing));
    drop_rare_kinds();
    if (!runs.empty())
      n_parts = static_cast<std::size_t>(
                  *std::max_element(A->column.begin(), A->column.end())) +
                1;
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



  /* Where the numbers of each row are, the same place for equal ones; null for
     those that few rows have. */
  template <int block, typename Number>
  typename RowRuns<block, Number>::Numbers
  RowRuns<block, Number>::find_equal(const std::vector<int> &changing) const
  {
    const std::size_t n = A->n_block_rows();
    std::vector<bool> stays(n, true);
    for (const int i : changing)
      stays[static_cast<std::size_t>(i)] = false;
    Numbers                                         numbers(n, nullptr);
    std::unordered_set<std::string_view>            known;
    std::unordered_map<const Number *, std::size_t> n_rows;
    for (std::size_t i = 0; i < n; ++i)
      if (const std::size_t length = A->start[i + 1] - A->start[i];
          stays[i] && length > 0)
        {
          const Number *own = A->block(i, A->start[i]).data();
          if (!A->shares_rows())
            own = reinterpret_cast<const Number *>(
              known
                .emplace(reinterpret_cast<const char *>(own),
                         length * Matrix::block_size * sizeof(Number))
                .first->data());
          numbers[i] = own;
          ++n_rows[own];
        }
    for (const Number *&own : numbers)
      if (n_rows[own] < least_rows)
        own = nullptr;
    return numbers;
  }



  template <int block, typename Number>
  void
  RowRuns<block, Number>::find_runs(const Numbers &numbers)
  {
    EqualRows<int>   known;
    std::vector<int> own;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        if (numbers[i] == nullptr)
          continue;
        own.clear();
        for (std::size_t k = A->start[i]; k < A->start[i + 1]; ++k)
          own.push_back(A->column[k] - static_cast<int>(i));
        const Run run = {i,
                         1,
                         own.size(),
                         numbers[i],
                         known.place(own.data(), own.size(), shifts)};
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
  RowRuns<block, Number>::operator()(const Number *x, Number *y) const
  {
    static const Kernels<Number> kernels = choose_kernels<block, Number>();
    parts.resize(n_parts * block);
    kernels.take_apart(x, n_parts, parts.data());
    std::size_t done = 0;
    for (const Run &run : runs)
      {
        A->multiply(done, run.begin, x, y);
        done                     = run.begin + run.n;
        const int *const columns = shifts.data() + run.shifts;
        if (run.is_wide())
          kernels.multiply(
            {run.numbers, columns, run.n_columns, parts.data(), n_parts},
            run.begin,
            run.n,
            y);
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
  template class RowRuns<6, float>;
} // namespace conetact::backends
