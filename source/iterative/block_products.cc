// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/block_products.h"

namespace conetact::iterative
{
  namespace
  {
    /**
     * A block times its part of x is the sum of its columns, each times one
     * number of x: a column fills a vector of the processor, which has no sums
     * across it then. Memory sets the pace: each number of A is read once. It
     * is inline by force, since an instance for some processor must not call
     * code that was compiled for all.
     */
    template <int n_rows, int n_columns, typename Number>
    [[gnu::always_inline]] inline void
    multiply_all(const BlockRows<Number> &A, const Number *x, Number *y)
    {
      constexpr int bytes = lanes(n_rows) * static_cast<int>(sizeof(Number));
      using Lanes         = typename Wide<Number, bytes>::Vector;
      using Anywhere      = typename Wide<Number, bytes>::Anywhere;
      constexpr std::size_t block_size =
        static_cast<std::size_t>(n_rows) * n_columns;
      for (std::size_t i = A.begin; i < A.end; ++i)
        {
          const Number *a =
            A.value +
            (A.first == nullptr ? A.start[i] * block_size : A.first[i]);
          // Each column of blocks has a sum of its own, so that none waits for
          // another; they are added pairwise in the end.
          Lanes sum[n_columns];
#pragma GCC unroll 8
          for (int c = 0; c < n_columns; ++c)
            sum[c] = Lanes{};
          for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
            {
              const Number *const in =
                x + static_cast<std::ptrdiff_t>(A.column[k]) * n_columns;
#pragma GCC unroll 8
              for (int c = 0; c < n_columns; ++c, a += n_rows)
                sum[c] += *reinterpret_cast<const Anywhere *>(a) * in[c];
            }
#pragma GCC unroll 8
          for (int c = n_columns - 1; c > 0; --c)
            sum[(c - 1) / 2] += sum[c];
          Number *const out = y + i * n_rows;
          // Spare numbers belong to the next row, which is written after this
          // one; behind the last row nothing may be touched.
          if (i + 1 < A.end)
            *reinterpret_cast<Anywhere *>(out) = sum[0];
          else
            for (int r = 0; r < n_rows; ++r)
              out[r] = sum[0][r];
        }
    }

    template <typename Number>
    using MultiplyRows = void(const BlockRows<Number> &A,
                              const Number            *x,
                              Number                  *y);

    template <int n_rows, int n_columns, typename Number>
    void
    multiply_plain(const BlockRows<Number> &A, const Number *x, Number *y)
    {
      multiply_all<n_rows, n_columns>(A, x, y);
    }
#ifdef __x86_64__
    template <int n_rows, int n_columns, typename Number>
    [[gnu::target("avx2,fma")]] void
    multiply_avx2(const BlockRows<Number> &A, const Number *x, Number *y)
    {
      multiply_all<n_rows, n_columns>(A, x, y);
    }
#endif

    /**
     * The choice is made as the program runs, as it may have been built on
     * another machine. Fused products round once, not twice: results differ in
     * their last bits between machines.
     */
    template <int n_rows, int n_columns, typename Number>
    MultiplyRows<Number> *
    choose_multiply()
    {
#ifdef __x86_64__
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return &multiply_avx2<n_rows, n_columns, Number>;
#endif
      return &multiply_plain<n_rows, n_columns, Number>;
    }
  } // namespace



  template <int n_rows, int n_columns, typename Number>
  void
  multiply_rows(const BlockRows<Number> &A, const Number *x, Number *y)
  {
    static MultiplyRows<Number> *const multiply =
      choose_multiply<n_rows, n_columns, Number>();
    multiply(A, x, y);
  }

#define CONETACT_MULTIPLY_ROWS(n_rows, n_columns, Number)                   \
  template void multiply_rows<n_rows, n_columns>(const BlockRows<Number> &, \
                                                 const Number *,            \
                                                 Number *)
  CONETACT_MULTIPLY_ROWS(2, 2, float);
  CONETACT_MULTIPLY_ROWS(2, 2, double);
  CONETACT_MULTIPLY_ROWS(2, 3, float);
  CONETACT_MULTIPLY_ROWS(3, 2, float);
  CONETACT_MULTIPLY_ROWS(3, 3, float);
  CONETACT_MULTIPLY_ROWS(3, 3, double);
  CONETACT_MULTIPLY_ROWS(3, 6, float);
  CONETACT_MULTIPLY_ROWS(6, 3, float);
  CONETACT_MULTIPLY_ROWS(6, 6, float);
  CONETACT_MULTIPLY_ROWS(6, 6, double);
#undef CONETACT_MULTIPLY_ROWS
} // namespace conetact::iterative
