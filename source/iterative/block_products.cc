// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/block_products.h"

namespace conetact::iterative
{
  namespace
  {
    // What run() does is told by an object of one of these.
    template <int n_rows, int n_columns>
    struct Multiply
    {};
    template <int size>
    struct AddUpper
    {};
    template <int n_rows, int n_columns>
    struct AddTransposed
    {};
    template <int size>
    struct MultiplyBlocks
    {};

    /** Asks memory for the numbers of a block long before their turn: a
     * processor looks no further ahead than a page. Nothing is read, so that
     * it may be behind the end. */
    template <std::size_t block_size, typename Number>
    [[gnu::always_inline]] inline void
    ask_ahead(const Number *const a)
    {
      constexpr std::size_t ahead = 2048, line = 64; // bytes
      for (std::size_t i = 0; i < block_size * sizeof(Number); i += line)
        __builtin_prefetch(reinterpret_cast<const char *>(a) + ahead + i);
    }

    /**
     * A block times its part of x is the sum of its columns, each times one
     * number of x: a column fills a vector of the processor, which has no sums
     * across it then. Memory sets the pace: each number of A is read once. It
     * is inline by force, since an instance for some processor must not call
     * code that was compiled for all.
     */
    template <int n_rows, int n_columns, typename Number>
    [[gnu::always_inline]] inline void
    run(const Multiply<n_rows, n_columns>,
        const BlockRows<Number> &A,
        const Number            *x,
        Number                  *y)
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
              ask_ahead<block_size>(a);
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

    /** The numbers of column c are those of vector c from its beginning. */
    template <int size, typename Number>
    struct Columns
    {
      static constexpr int bytes =
        lanes(size) * static_cast<int>(sizeof(Number));
      using Lanes    = typename Wide<Number, bytes>::Vector;
      using Anywhere = typename Wide<Number, bytes>::Anywhere;
      Lanes column[size];

      [[gnu::always_inline]] explicit Columns(const Number *const a)
      {
#pragma GCC unroll 8
        for (int c = 0; c < size; ++c)
          column[c] = *reinterpret_cast<const Anywhere *>(a + c * size);
      }
    };

    /** The product of the transposed block with a node's part of x, each number
     * of which fills a vector. Three columns are turned into rows first, as a
     * sum across a vector takes longer. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    multiply_transposed(const Columns<3, Number>                 &a,
                        const typename Columns<3, Number>::Lanes *x,
                        typename Columns<3, Number>::Lanes       &y)
    {
      const auto low =
        __builtin_shufflevector(a.column[0], a.column[1], 0, 4, 1, 5);
      const auto high =
        __builtin_shufflevector(a.column[0], a.column[1], 2, 6, 3, 7);
      y = __builtin_shufflevector(low, a.column[2], 0, 1, 4, 4) * x[0] +
          __builtin_shufflevector(low, a.column[2], 2, 3, 5, 5) * x[1] +
          __builtin_shufflevector(high, a.column[2], 0, 1, 6, 6) * x[2];
    }
    template <typename Number>
    [[gnu::always_inline]] inline void
    multiply_transposed(const Columns<2, Number>                 &a,
                        const typename Columns<2, Number>::Lanes *x,
                        typename Columns<2, Number>::Lanes       &y)
    {
      for (int c = 0; c < 2; ++c)
        y[c] = a.column[c][0] * x[0][0] + a.column[c][1] * x[1][0];
    }

    /** Numbers of y are added to one by one: those of a next node, which a
     * whole vector would write as well, may be under way. */
    template <int size, typename Number>
    [[gnu::always_inline]] inline void
    run(const AddUpper<size>,
        const BlockRows<Number> &A,
        const Number            *x,
        Number                  *y)
    {
      using Block                      = Columns<size, Number>;
      using Lanes                      = typename Block::Lanes;
      constexpr std::size_t block_size = static_cast<std::size_t>(size) * size;

      for (std::size_t i = A.begin; i < A.end; ++i)
        {
          const Number *const own = x + i * size;
          Lanes               sum[size], part[size];
          const Number       *a = A.value + A.start[i] * block_size;
          const Block         diagonal(a);
#pragma GCC unroll 8
          for (int c = 0; c < size; ++c)
            {
              part[c] = Lanes{} + own[c];
              sum[c]  = diagonal.column[c] * own[c];
            }
          for (std::size_t k = A.start[i] + 1; k < A.start[i + 1]; ++k)
            {
              ask_ahead<block_size>(a);
              const Block          beside(a += block_size);
              const std::ptrdiff_t j =
                static_cast<std::ptrdiff_t>(A.column[k]) * size;
              Lanes transposed;
              multiply_transposed(beside, part, transposed);
#pragma GCC unroll 8
              for (int c = 0; c < size; ++c)
                {
                  sum[c] += beside.column[c] * x[j + c];
                  y[j + c] += transposed[c];
                }
            }
#pragma GCC unroll 8
          for (int c = 1; c < size; ++c)
            sum[0] += sum[c];
#pragma GCC unroll 8
          for (int r = 0; r < size; ++r)
            y[i * size + r] += sum[0][r];
        }
    }

    template <int n_rows, int n_columns, typename Number>
    [[gnu::always_inline]] inline void
    run(const AddTransposed<n_rows, n_columns>,
        const BlockRows<Number> &A,
        const Number            *x,
        Number                  *y)
    {
      constexpr std::size_t block_size =
        static_cast<std::size_t>(n_rows) * n_columns;
      constexpr bool in_threes = n_rows == 3 && n_columns % 3 == 0;
      for (std::size_t i = A.begin; i < A.end; ++i)
        {
          const Number *const own = x + i * n_rows;
          const Number       *a   = A.value + A.start[i] * block_size;
          for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
            {
              ask_ahead<block_size>(a);
              Number *out =
                y + static_cast<std::ptrdiff_t>(A.column[k]) * n_columns;
              if constexpr (in_threes)
                {
                  using Lanes         = typename Columns<3, Number>::Lanes;
                  const Lanes part[3] = {Lanes{} + own[0],
                                         Lanes{} + own[1],
                                         Lanes{} + own[2]};
#pragma GCC unroll 8
                  for (int c = 0; c < n_columns; c += 3, a += 9, out += 3)
                    {
                      Lanes product;
                      multiply_transposed(Columns<3, Number>(a), part, product);
#pragma GCC unroll 8
                      for (int r = 0; r < 3; ++r)
                        out[r] += product[r];
                    }
                }
              else
                for (int c = 0; c < n_columns; ++c, a += n_rows)
                  {
                    Number sum = 0;
#pragma GCC unroll 8
                    for (int r = 0; r < n_rows; ++r)
                      sum += a[r] * own[r];
                    out[c] += sum;
                  }
            }
        }
    }

    /** Blocks of B, all from the left by one matrix, whose columns stay in
     * vectors of the processor: each column of the result is written once. */
    template <int size, typename Number>
    [[gnu::always_inline]] inline void
    run(const MultiplyBlocks<size>,
        const BlockRows<Number> &B,
        const Number            *by,
        Number                  *result)
    {
      using Block    = Columns<size, Number>;
      using Lanes    = typename Block::Lanes;
      using Anywhere = typename Block::Anywhere;
      const Block         factor(by);
      const Number       *b   = B.value;
      const Number *const end = b + B.end * size * size;
      for (; b < end; b += size, result += size)
        {
          Lanes sum = factor.column[0] * b[0];
#pragma GCC unroll 8
          for (int c = 1; c < size; ++c)
            sum += factor.column[c] * b[c];
          *reinterpret_cast<Anywhere *>(result) = sum;
        }
    }

    // Each product in the vectors that all processors have, and in wider ones.
    template <typename Product, typename Number>
    void
    run_plain(const BlockRows<Number> &A, const Number *x, Number *y)
    {
      run(Product(), A, x, y);
    }
#ifdef __x86_64__
    template <typename Product, typename Number>
    [[gnu::target("avx2,fma")]] void
    run_wide(const BlockRows<Number> &A, const Number *x, Number *y)
    {
      run(Product(), A, x, y);
    }
#endif

    /**
     * The choice is made as the program runs, as it may have been built on
     * another machine. Fused products round once, not twice: results differ in
     * their last bits between machines.
     */
    template <typename Product, typename Number>
    void
    run_chosen(const BlockRows<Number> &A, const Number *x, Number *y)
    {
#ifdef __x86_64__
      static const bool is_wide =
        __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
      if (is_wide)
        return run_wide<Product>(A, x, y);
#endif
      run_plain<Product>(A, x, y);
    }
  } // namespace



  template <int n_rows, int n_columns, typename Number>
  void
  multiply_rows(const BlockRows<Number> &A, const Number *x, Number *y)
  {
    run_chosen<Multiply<n_rows, n_columns>>(A, x, y);
  }



  template <int size, typename Number>
  void
  add_upper_rows(const BlockRows<Number> &A, const Number *x, Number *y)
  {
    run_chosen<AddUpper<size>>(A, x, y);
  }



  template <int n_rows, int n_columns, typename Number>
  void
  add_transposed_rows(const BlockRows<Number> &A, const Number *x, Number *y)
  {
    run_chosen<AddTransposed<n_rows, n_columns>>(A, x, y);
  }

  template <int size, typename Number>
  void
  multiply_blocks(const Number     *factor,
                  const Number     *blocks,
                  const std::size_t n,
                  Number           *result)
  {
    run_chosen<MultiplyBlocks<size>>(
      BlockRows<Number>{nullptr, nullptr, nullptr, blocks, 0, n},
      factor,
      result);
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
#define CONETACT_ADD_UPPER_ROWS(size, Number)                   \
  template void add_upper_rows<size>(const BlockRows<Number> &, \
                                     const Number *,            \
                                     Number *)
  CONETACT_ADD_UPPER_ROWS(2, float);
  CONETACT_ADD_UPPER_ROWS(2, double);
  CONETACT_ADD_UPPER_ROWS(3, float);
  CONETACT_ADD_UPPER_ROWS(3, double);
#undef CONETACT_ADD_UPPER_ROWS
  template void
  multiply_blocks<3>(const float *, const float *, std::size_t, float *);
  template void
  multiply_blocks<6>(const float *, const float *, std::size_t, float *);
  template void
  add_transposed_rows<2, 3>(const BlockRows<float> &, const float *, float *);
  template void
  add_transposed_rows<3, 3>(const BlockRows<float> &, const float *, float *);
  template void
  add_transposed_rows<3, 6>(const BlockRows<float> &, const float *, float *);
  template void
  add_transposed_rows<6, 6>(const BlockRows<float> &, const float *, float *);
} // namespace conetact::iterative
