// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/smoothed_aggregation.h"

#include "conetact/base/index.h"
#include "conetact/base/partition.h"
#include "conetact/iterative/aggregates.h"
#include "conetact/iterative/rows_of_others.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace conetact::iterative
{
  namespace
  {
    /**
     * A mode of an aggregate counts as spanned by those before it if no more
     * than this part of it is left. A turn about an origin at the distance L
     * leaves h / L of itself, h the size of the aggregate, which is far more;
     * rounding leaves 1e-16.
     */
    constexpr double same = 1e-7;

    /** Makes it the next row of a matrix. */
    template <int n_rows, int n_columns, typename Number>
    void
    append(const GrowingRow<n_rows, n_columns>    &row,
           BlockMatrix<n_rows, n_columns, Number> &A)
    {
      row.append_to(A.column, A.value);
      A.start.push_back(A.column.size());
    }

    /** Columns are read in fours: so many numbers more than blocks have. */
    constexpr std::size_t spare = 8;

    /** Room for so many blocks. */
    template <typename Matrix>
    void
    reserve(const std::size_t n, Matrix &A)
    {
      A.column.reserve(n);
      A.value.reserve(n * A.block_size + spare);
    }

    void
    add_once(const int i, std::vector<int> &list)
    {
      if (std::find(list.begin(), list.end(), i) == list.end())
        list.push_back(i);
    }

    /**
     * Orthogonal columns that span those of B, one after the other (Gram and
     * Schmidt, twice for the sake of rounding); zero where those before them
     * span them. The same for equal aggregates anywhere in a body: its
     * translations come first, and turns about their own centre are left of
     * the others.
     */
    Eigen::MatrixXd
    orthogonal(const Eigen::MatrixXd &B)
    {
      Eigen::MatrixXd Q = B;
      for (Eigen::Index j = 0; j < B.cols(); ++j)
        {
          for (int pass = 0; pass < 2; ++pass)
            for (Eigen::Index i = 0; i < j; ++i)
              Q.col(j) -= Q.col(i).dot(Q.col(j)) * Q.col(i);
          const double left = Q.col(j).norm();
          Q.col(j) *= left > same * B.col(j).norm() ? 1. / left : 0.;
        }
      return Q;
    }

    /** Rounded, so that equal aggregates have the same numbers to the last
     * bit: their rows are kept once (RowRuns). Columns have the norm one; the
     * quantum is four times the spacing of single precision just below that. */
    float
    rounded(const double x)
    {
      constexpr double quantum = 0x1p-22;
      return static_cast<float>(std::round(x / quantum) * quantum);
    }

    /** An aggregate has the side of its nodes, which are all on one. */
    std::vector<int>
    sides_of(const std::vector<int> &aggregate_of,
             const int               n_aggregates,
             const std::vector<int> &side)
    {
      std::vector<int> result(side.empty() ? 0 : at(n_aggregates));
      for (std::size_t i = 0; i < side.size(); ++i)
        result[at(aggregate_of[i])] = side[i];
      return result;
    }

    bool
    is_alone(const std::size_t i, const std::vector<int> &side)
    {
      return !side.empty() && side[i] < 0;
    }

    /**
     * The tentative prolongator T: orthogonal modes of each aggregate, in one
     * block for each node; and what they are made of. Aggregates with fewer
     * motions than modes keep columns of zeros, so that blocks are of one size.
     */
    template <int size, int coarse>
    BlockMatrix<size, coarse, float>
    orthogonal_modes(const std::vector<int> &aggregate_of,
                     const int               n_aggregates,
                     const int               begin,
                     const LevelAbove<size> &above,
                     Eigen::MatrixXd        &coarse_modes)
    {
      std::vector<std::vector<int>> nodes(at(n_aggregates));
      for (std::size_t i = 0; i < aggregate_of.size(); ++i)
        nodes[at(aggregate_of[i])].push_back(static_cast<int>(i));
      BlockMatrix<size, coarse, float> T;
      T.start.resize(aggregate_of.size() + 1);
      std::iota(T.start.begin(), T.start.end(), std::size_t(0));
      T.allocate();
      coarse_modes.setZero(Eigen::Index(n_aggregates) * coarse, coarse);
      for (int a = 0; a < n_aggregates; ++a)
        {
          const auto     &own = nodes[at(a)];
          Eigen::MatrixXd B(Eigen::Index(own.size()) * size, coarse);
          for (std::size_t k = 0; k < own.size(); ++k)
            B.middleRows<size>(Eigen::Index(k) * size) =
              above.modes.template middleRows<size>(Eigen::Index(own[k]) *
                                                    size);
          const Eigen::MatrixXd Q = orthogonal(B);
          coarse_modes.middleRows<coarse>(Eigen::Index(a) * coarse) =
            Q.transpose() * B;
          for (std::size_t k = 0; k < own.size(); ++k)
            {
              T.column[at(own[k])] = begin + a;
              T.block(at(own[k])) =
                Q.middleRows<size>(Eigen::Index(k) * size).unaryExpr(&rounded);
              // No mode moves it: the column of its unknown is made by hand.
              if (is_alone(at(own[k]), above.side))
                T.block(at(own[k]))(0, 0) = 1;
            }
        }
      T.value.resize(T.column.size() * T.block_size);
      return T;
    }

    /** Blocks of A T, where T has one in each row, are counted beforehand: a
     * vector that grows takes up to three times its memory. */
    template <int size, int coarse>
    std::size_t
    n_blocks_of_product(const DistributedMatrix<size, size, double> &A,
                        const BlockMatrix<size, coarse, float>      &T)
    {
      std::size_t      n = 0;
      std::vector<int> columns;
      for (std::size_t i = 0; i < A.own_part().n_block_rows(); ++i)
        {
          columns.clear();
          A.for_row(i, [&](const int j, const auto &) {
            add_once(T.column[at(j)], columns);
          });
          n += columns.size();
        }
      return n;
    }

    /**
     * One step of Jacobi's method, P = (1 - omega D A) T with
     * omega = 4 / (3 lambda), lambda the largest eigenvalue of D A: the largest
     * x (1 - omega x)^2 of 0 <= x <= lambda, a bound of energies, is lambda / 9
     * then and no less for any other factor.
     */
    template <int size, int coarse>
    BlockMatrix<size, coarse, float>
    smoothed(const LevelAbove<size>          &above,
             BlockMatrix<size, coarse, float> T,
             const Communicator              &processes)
    {
      // Columns of own rows of A are nodes of others as well, across the
      // border: A T needs their rows of T.
      append_rows_of_others(above.A, processes, T);
      const double omega =
        4. / 3 / static_cast<double>(above.largest) / above.unit;
      BlockMatrix<size, coarse, float> P;
      reserve(n_blocks_of_product(above.A, T), P);
      GrowingRow<size, coarse> row;
      for (std::size_t i = 0; i < above.A.own_part().n_block_rows(); ++i)
        {
          row.clear();
          if (!is_alone(i, above.side))
            above.A.for_row(i, [&](const int j, const auto &a) {
              row[T.column[at(j)]].noalias() +=
                a * T.block(at(j)).template cast<double>();
            });
          const Eigen::Matrix<double, size, size> D =
            -omega * above.D[i].template cast<double>();
          for (auto &block : row.block)
            block = D * block;
          row[T.column[i]] += T.block(i).template cast<double>();
          append(row, P);
        }
      return P;
    }

    /**
     * Rows of P^T A P: those of own aggregates, and behind them those of others
     * to which own rows of A add. With the rows of A and P, it is the sum of
     * P_i^T (sum_j A_ij P_j) over i: no transposed matrix and no A P is kept.
     * Columns are found before numbers, so that rows have their memory once.
     */
    template <int size, int coarse>
    class Projection
    {
    public:
      using Sums = BlockMatrix<coarse, coarse, double>;

      /** P has the rows of others that A needs. */
      Projection(const LevelAbove<size>                 &level_above,
                 const BlockMatrix<size, coarse, float> &prolongator,
                 const std::vector<int>                 &first_aggregates,
                 const Communicator                     &all)
        : above(level_above)
        , P(prolongator)
        , first(first_aggregates)
        , processes(all)
        , begin(first[at(processes.rank())])
        , n_own(first[at(processes.rank()) + 1] - begin)
      {}

      /** Own rows, with what other processes add to them. */
      Sums
      rows()
      {
        find_columns();
        allocate();
        add_all();
        if (processes.size() > 1)
          exchange_rows();
        return std::move(sums);
      }

    private:
      /** Row of an aggregate. */
      std::size_t
      place(const int a) const
      {
        if (a >= begin && a < begin + n_own)
          return at(a - begin);
        return at(n_own) + static_cast<std::size_t>(
                             std::lower_bound(others.begin(), others.end(), a) -
                             others.begin());
      }
      int
      n_rows() const
      {
        return static_cast<int>(above.A.own_part().n_block_rows());
      }

      void
      find_columns()
      {
        for (std::size_t k = 0; k < P.start[at(n_rows())]; ++k)
          if (const int a = P.column[k]; a < begin || a >= begin + n_own)
            others.push_back(a);
        std::sort(others.begin(), others.end());
        others.erase(std::unique(others.begin(), others.end()), others.end());
        columns.resize(at(n_own) + others.size());
        std::vector<int> of_row;
        for (int i = 0; i < n_rows(); ++i)
          {
            of_row.clear();
            above.A.for_row(at(i), [&](const int j, const auto &) {
              for (std::size_t k = P.start[at(j)]; k < P.start[at(j) + 1]; ++k)
                add_once(P.column[k], of_row);
            });
            for (std::size_t k = P.start[at(i)]; k < P.start[at(i) + 1]; ++k)
              for (const int b : of_row)
                add_once(b, columns[place(P.column[k])]);
          }
        if (processes.size() > 1)
          exchange_columns();
      }
      /** Own aggregates learn their columns from those who add to their rows.
       */
      void
      exchange_columns()
      {
        std::vector<std::vector<int>> lists(at(processes.size()));
        for (const int a : others)
          {
            const std::vector<int> &row = columns[place(a)];
            pack<double>(a,
                         row.data(),
                         row.size(),
                         nullptr,
                         0,
                         lists[at(owner_of(a, first))]);
          }
        for (const std::vector<int> &list : processes.exchange(lists))
          unpack<double>(list,
                         0,
                         [&](const int         a,
                             const int        *its_columns,
                             const std::size_t n,
                             const double *) {
                           for (std::size_t k = 0; k < n; ++k)
                             add_once(its_columns[k], columns[place(a)]);
                         });
      }
      void
      allocate()
      {
        for (std::vector<int> &row : columns)
          {
            std::sort(row.begin(), row.end());
            sums.start.push_back(sums.start.back() + row.size());
          }
        sums.allocate();
        std::size_t k = 0;
        for (const std::vector<int> &row : columns)
          for (const int column : row)
            sums.column[k++] = column;
        columns = {};
      }
      auto
      block(const std::size_t row, const int column)
      {
        const auto from =
          sums.column.begin() + static_cast<std::ptrdiff_t>(sums.start[row]);
        const auto to = sums.column.begin() +
                        static_cast<std::ptrdiff_t>(sums.start[row + 1]);
        return sums.block(static_cast<std::size_t>(
          std::lower_bound(from, to, column) - sums.column.begin()));
      }

      void
      add_all()
      {
        GrowingRow<size, coarse> AP;
        for (int i = 0; i < n_rows(); ++i)
          {
            AP.clear();
            above.A.for_row(at(i), [&](const int j, const auto &a) {
              for (std::size_t k = P.start[at(j)]; k < P.start[at(j) + 1]; ++k)
                AP[P.column[k]].noalias() +=
                  a * P.block(at(j), k).template cast<double>();
            });
            for (std::size_t k = P.start[at(i)]; k < P.start[at(i) + 1]; ++k)
              {
                const std::size_t row = place(P.column[k]);
                const Eigen::Matrix<double, size, coarse> p =
                  P.block(at(i), k).template cast<double>() / above.unit;
                for (std::size_t l = 0; l < AP.column.size(); ++l)
                  block(row, AP.column[l]).noalias() +=
                    p.transpose() * AP.block[l];
              }
          }
      }
      /** Rows of others are sent to them, and go. */
      void
      exchange_rows()
      {
        std::vector<std::vector<int>> lists(at(processes.size()));
        for (const int a : others)
          {
            const std::size_t row = place(a), from = sums.start[row],
                              n = sums.start[row + 1] - from;
            pack(a,
                 sums.column.data() + from,
                 n,
                 sums.block(from).data(),
                 n * sums.block_size,
                 lists[at(owner_of(a, first))]);
          }
        sums.start.resize(at(n_own) + 1);
        sums.column.resize(sums.start.back());
        sums.value.resize(sums.start.back() * sums.block_size + spare);
        for (const std::vector<int> &list : processes.exchange(lists))
          unpack<double>(list,
                         sums.block_size,
                         [&](const int         a,
                             const int        *its_columns,
                             const std::size_t n,
                             const double     *values) {
                           for (std::size_t k = 0; k < n; ++k)
                             block(place(a), its_columns[k]) +=
                               Eigen::Map<const typename Sums::Block>(
                                 values + k * sums.block_size);
                         });
      }

      const LevelAbove<size>                 &above;
      const BlockMatrix<size, coarse, float> &P;
      const std::vector<int>       &first; ///< aggregates of processes
      const Communicator           &processes;
      const int                     begin, n_own;
      std::vector<int>              others;  ///< aggregates, ascending
      std::vector<std::vector<int>> columns; ///< of each row
      Sums                          sums;
    };

    /** Own rows of P^T A P, for which P has rows of others for a while. */
    template <int size, int coarse>
    BlockMatrix<coarse, coarse, double>
    project(const LevelAbove<size>           &above,
            const std::vector<int>           &first,
            const Communicator               &processes,
            BlockMatrix<size, coarse, float> &P)
    {
      const std::size_t n_own = P.n_block_rows();
      append_rows_of_others(above.A, processes, P);
      auto result = Projection<size, coarse>(above, P, first, processes).rows();
      // Rows of others have served: from here on each process multiplies by its
      // own rows of P.
      P.start.resize(n_own + 1);
      P.column.resize(P.start.back());
      P.value.resize(P.start.back() * P.block_size + spare);
      return result;
    }
  } // namespace

  /* Modes of the coarse level are B_c = Q^T B of each aggregate: T B_c = B but
     for rounding, so that all levels have the rigid motions. */
  template <int size, int coarse>
  CoarseLevel<size, coarse>
  aggregate(const LevelAbove<size> &above, const Communicator &processes)
  {
    CoarseLevel<size, coarse> level;
    int                       n_own = 0;
    const std::vector<int>    aggregate_of =
      aggregates(above.A, above.side, n_own);
    level.rows.first = first_numbers(n_own, processes);
    level.rows.side  = sides_of(aggregate_of, n_own, above.side);
    level.P          = smoothed(
      above,
      orthogonal_modes<size, coarse>(aggregate_of,
                                     n_own,
                                     level.rows.first[at(processes.rank())],
                                     above,
                                     level.rows.modes),
      processes);
    level.rows.A = project(above, level.rows.first, processes, level.P);

    return level;
  }

  template CoarseLevel<2, 3>
  aggregate(const LevelAbove<2> &, const Communicator &);
  template CoarseLevel<3, 3>
  aggregate(const LevelAbove<3> &, const Communicator &);
  template CoarseLevel<3, 6>
  aggregate(const LevelAbove<3> &, const Communicator &);
  template CoarseLevel<6, 6>
  aggregate(const LevelAbove<6> &, const Communicator &);
} // namespace conetact::iterative
