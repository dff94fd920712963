// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/row_runs.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace conetact::iterative
{
  namespace
  {
    /** Rows that are alike are as many at least: numbers of fewer rows are not
     * worth a place in the cache. */
    constexpr std::size_t least_rows = 256;

    /** A strip at least of the widest vectors that processors have. */
    template <typename Number>
    bool
    is_wide(const RowRun<Number> &run)
    {
      return run.n >= Wide<Number, 64>::width;
    }

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

    /**
     * Strips of `width` rows each, one behind the other, beginning with `row`.
     * As rows i, i + 1, ... have the same numbers in columns that ascend by
     * one, @f$y_{i+l} = \sum_k A_k x_{i+l+s_k}@f$: a number of A_k meets
     * neighbours of x, one vector of the processor if components stand apart.
     */
    template <int block, typename Number, int bytes, int n_strips>
    [[gnu::always_inline]] inline void
    multiply_strips(const Alike<Number> &rows, const std::size_t row, Number *y)
    {
      using Vector                = typename Wide<Number, bytes>::Vector;
      using Anywhere              = typename Wide<Number, bytes>::Anywhere;
      constexpr std::size_t width = Wide<Number, bytes>::width;
      Vector                sum[block][n_strips];
#pragma GCC unroll 8
      for (int r = 0; r < block; ++r)
#pragma GCC unroll 8
        for (int s = 0; s < n_strips; ++s)
          sum[r][s] = Vector{};
      const Number *a = rows.numbers;
      for (std::size_t k = 0; k < rows.n_columns; ++k)
        {
          const Number *in = rows.parts + row + rows.shifts[k];
#pragma GCC unroll 8
          for (int c = 0; c < block; ++c, in += rows.n_parts)
            {
              Vector x[n_strips];
#pragma GCC unroll 8
              for (int s = 0; s < n_strips; ++s)
                x[s] = *reinterpret_cast<const Anywhere *>(in + s * width);
#pragma GCC unroll 8
              for (int r = 0; r < block; ++r, ++a)
#pragma GCC unroll 8
                for (int s = 0; s < n_strips; ++s)
                  sum[r][s] += *a * x[s];
            }
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

    /** As many strips at once as there are rows for. The last ones overlap
     * those before them and write the same numbers again: no row is left over.
     */
    template <int block, typename Number, int bytes, int n_strips>
    [[gnu::always_inline]] inline void
    multiply_run(const Alike<Number> &rows,
                 const std::size_t    begin,
                 const std::size_t    n,
                 Number              *y)
    {
      constexpr std::size_t many = n_strips * Wide<Number, bytes>::width;
      if constexpr (n_strips > 1)
        if (n < many)
          return multiply_run<block, Number, bytes, n_strips - 1>(rows,
                                                                  begin,
                                                                  n,
                                                                  y);
      for (std::size_t row = 0; row < n; row += many)
        multiply_strips<block, Number, bytes, n_strips>(
          rows, begin + std::min(row, n - many), y);
    }

    template <int block, typename Number>
    [[gnu::always_inline]] inline void
    take_apart(const Number *x, const std::size_t n, Number *parts)
    {
      for (std::size_t i = 0; i < n; ++i)
        for (int c = 0; c < block; ++c)
          parts[static_cast<std::size_t>(c) * n + i] = *x++;
    }

    /** Multiplies all runs that are wide; `parts` is room for x taken apart,
     * which costs one pass over x. */
    template <int block, typename Number, int bytes, int most_strips>
    [[gnu::always_inline]] inline void
    multiply_runs(const std::vector<RowRun<Number>> &runs,
                  const int                         *shifts,
                  const Number                      *x,
                  std::vector<Number>               &parts,
                  Number                            *y)
    {
      const std::size_t n = parts.size() / block;
      take_apart<block>(x, n, parts.data());
      for (const RowRun<Number> &run : runs)
        if (is_wide(run))
          multiply_run<block, Number, bytes, most_strips>(
            {run.numbers, shifts + run.shifts, run.n_columns, parts.data(), n},
            run.begin,
            run.n,
            y);
    }

    template <typename Number>
    using MultiplyRuns = void(const std::vector<RowRun<Number>> &runs,
                              const int                         *shifts,
                              const Number                      *x,
                              std::vector<Number>               &parts,
                              Number                            *y);

    // Processors differ in the width of their vectors and in how many they
    // hold. Of 16 these take block * strips sums (8, 9 and 12: each waits for
    // its own last product, so that several must be under way), a vector of x
    // for each strip and a number of A: 13 or 15. AVX-512 has twice as many.
    template <int block>
    constexpr int strips_of_sixteen = block == 2 ? 4 :
                                      block == 3 ? 3 :
                                                   2;
    template <int block, typename Number>
    void
    multiply_plain(const std::vector<RowRun<Number>> &runs,
                   const int                         *shifts,
                   const Number                      *x,
                   std::vector<Number>               &parts,
                   Number                            *y)
    {
      multiply_runs<block, Number, 16, strips_of_sixteen<block>>(
        runs, shifts, x, parts, y);
    }
#ifdef __x86_64__
    template <int block, typename Number>
    [[gnu::target("avx2,fma")]] void
    multiply_avx2(const std::vector<RowRun<Number>> &runs,
                  const int                         *shifts,
                  const Number                      *x,
                  std::vector<Number>               &parts,
                  Number                            *y)
    {
      multiply_runs<block, Number, 32, strips_of_sixteen<block>>(
        runs, shifts, x, parts, y);
    }
    template <int block, typename Number>
    [[gnu::target("avx512f,prefer-vector-width=512")]] void
    multiply_avx512(const std::vector<RowRun<Number>> &runs,
                    const int                         *shifts,
                    const Number                      *x,
                    std::vector<Number>               &parts,
                    Number                            *y)
    {
      multiply_runs<block, Number, 64, 2>(runs, shifts, x, parts, y);
    }
#endif

    template <int block, typename Number>
    MultiplyRuns<Number> *
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
  RowRuns<block, Number>::RowRuns(const Matrix           &matrix,
                                  const std::vector<int> &changing)
    : A(&matrix)
  {
    if (A->is_upper)
      return;
    find_runs(find_equal(changing));
    drop_rare_kinds();
    if (!runs.empty())
      parts.resize(block *
                   (static_cast<std::size_t>(
                      *std::max_element(A->column.begin(), A->column.end())) +
                    1));
  }



  template <int block, typename Number>
  std::size_t
  RowRuns<block, Number>::n_rows() const
  {
    std::size_t n = 0;
    for (const RowRun<Number> &run : runs)
      if (is_wide(run))
        n += run.n;
    return n;
  }



  /* Where the numbers of each row are, the same place for equal ones; null for
     those that few rows have. Places are compared from here on, not numbers:
     rows that change must not be among them. */
  template <int block, typename Number>
  typename RowRuns<block, Number>::Numbers
  RowRuns<block, Number>::find_equal(const std::vector<int> &changing) const
  {
    Assert(std::all_of(changing.begin(),
                       changing.end(),
                       [&](const int i) {
                         return i >= 0 &&
                                static_cast<std::size_t>(i) < A->n_block_rows();
                       }),
           dealii::ExcMessage("What changes are rows of the matrix."));
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



  /* Rows are of one kind if columns less the row are the same, too. */
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
        // Equal numbers and equal shifts are kept once, so that their places
        // tell whether the run goes on.
        const RowRun<Number> run = {i,
                                    1,
                                    own.size(),
                                    numbers[i],
                                    known.place(own.data(),
                                                own.size(),
                                                shifts)};
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
    for (const RowRun<Number> &run : runs)
      rows[{run.numbers, run.shifts}] += run.n;
    runs.erase(
      std::remove_if(runs.begin(),
                     runs.end(),
                     [&](const RowRun<Number> &run) {
                       return rows[{run.numbers, run.shifts}] < least_rows;
                     }),
      runs.end());
  }



  /* Wide runs first; then all other rows in ascending order: those between runs
     as the matrix has them, those of short runs with the numbers of their kind,
     which are in the cache. */
  template <int block, typename Number>
  void
  RowRuns<block, Number>::operator()(const Number *x, Number *y) const
  {
    if (runs.empty())
      return A->multiply(x, y);
    static MultiplyRuns<Number> *const multiply =
      choose_multiply<block, Number>();
    multiply(runs, shifts.data(), x, parts, y);
    std::size_t done = 0;
    for (const RowRun<Number> &run : runs)
      {
        A->multiply(done, run.begin, x, y);
        done = run.begin + run.n;
        if (is_wide(run))
          continue;
        const std::size_t own[2] = {0, run.n_columns};
        for (std::size_t i = run.begin; i < done; ++i)
          multiply_rows<block, block>(
            {own, shifts.data() + run.shifts, nullptr, run.numbers, 0, 1},
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
} // namespace conetact::iterative
