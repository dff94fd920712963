// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/smoothed_aggregation.h"

#include "conetact/base/index.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

namespace conetact::backends
{
  namespace
  {
    /** Modes of an aggregate that are so much the same count as one. */
    constexpr double same = 1e-7;

    /** Over the geometric mean of the diagonal blocks of two nodes: below it
     * they are not neighbours, such as those of a hard and a soft body. */
    constexpr double weak = .02;

    /**
     * The aggregate of each own node: nodes all of whose neighbours are free
     * yet begin one with these, others join one of their neighbours', and those
     * that are left make what they can.
     */
    template <int size>
    std::vector<int>
    group(const DistributedMatrix<size, size, double> &A, int &n_aggregates)
    {
      const auto      &own  = A.own_part();
      const int        n    = static_cast<int>(own.n_block_rows());
      constexpr int    none = -1;
      std::vector<int> of(at(n), none);
      Eigen::VectorXd  least = Eigen::VectorXd::Zero(n);
      for (int i = 0; i < n; ++i)
        A.for_row(at(i), [&](const int j, const auto &block) {
          if (j == i)
            least[i] = weak * block.norm();
        });
      const auto neighbours = [&](const int i, const auto &f) {
        for (std::size_t k = own.start[at(i)]; k < own.start[at(i) + 1]; ++k)
          if (const int j = own.column[k];
              own.block(at(i), k).squaredNorm() >= least[i] * least[j])
            f(j);
      };
      const auto begin_with = [&](const int i) {
        of[at(i)] = n_aggregates;
        neighbours(i, [&](const int j) {
          if (of[at(j)] == none)
            of[at(j)] = n_aggregates;
        });
        ++n_aggregates;
      };
      n_aggregates = 0;
      for (int i = 0; i < n; ++i)
        {
          bool free = of[at(i)] == none;
          neighbours(i, [&](const int j) { free &= of[at(j)] == none; });
          if (free)
            begin_with(i);
        }
      std::vector<int>   joined = of;
      std::map<int, int> votes;
      for (int i = 0; i < n; ++i)
        if (of[at(i)] == none)
          {
            votes.clear();
            neighbours(i, [&](const int j) {
              if (of[at(j)] != none)
                ++votes[of[at(j)]];
            });
            const auto most =
              std::max_element(votes.begin(),
                               votes.end(),
                               [](const auto &a, const auto &b) {
                                 return a.second < b.second;
                               });
            if (most != votes.end())
              joined[at(i)] = most->first;
          }
      of.swap(joined);
      for (int i = 0; i < n; ++i)
        if (of[at(i)] == none)
          begin_with(i);
      return of;
    }

    /** Nodes of all processes, from the number of each. */
    std::vector<int>
    number(const int n_own, const Communicator &processes)
    {
      const Eigen::VectorXi n = processes.gather_all(
        Eigen::VectorXi(Eigen::VectorXi::Constant(1, n_own)));
      std::vector<int> first(at(static_cast<int>(n.size())) + 1, 0);
      std::partial_sum(n.begin(), n.end(), first.begin() + 1);
      return first;
    }

    /** As ints, which processes exchange. */
    template <typename Number>
    void
    pack(const int         i,
         const int        *columns,
         const std::size_t n_columns,
         const Number     *values,
         const std::size_t n_values,
         std::vector<int> &list)
    {
      static_assert(sizeof(Number) % sizeof(int) == 0);
      list.push_back(i);
      list.push_back(static_cast<int>(n_columns));
      list.insert(list.end(), columns, columns + n_columns);
      const std::size_t end = list.size();
      list.resize(end + n_values * sizeof(Number) / sizeof(int));
      std::memcpy(list.data() + end, values, n_values * sizeof(Number));
    }

    /** Calls f(number, columns, how many, values) for all that was packed. */
    template <typename Number, typename F>
    void
    unpack(const std::vector<int> &list,
           const std::size_t       block_size,
           const F                &f)
    {
      std::vector<Number> values;
      for (std::size_t k = 0; k < list.size();)
        {
          const int         i = list[k];
          const std::size_t n = at(list[k + 1]);
          values.resize(n * block_size);
          std::memcpy(values.data(),
                      list.data() + k + 2 + n,
                      values.size() * sizeof(Number));
          f(i, list.data() + k + 2, n, values.data());
          k += 2 + n + values.size() * sizeof(Number) / sizeof(int);
        }
    }

    /** Behind own rows of a matrix those of others that A needs. */
    template <int size, int coarse>
    void
    append_rows_of_others(const DistributedMatrix<size, size, double> &A,
                          const Communicator               &processes,
                          BlockMatrix<size, coarse, float> &rows)
    {
      if (processes.size() == 1)
        return;
      std::vector<std::vector<int>> lists(at(processes.size()));
      for (const HaloPlan::Side &side : A.halo_plan().sides)
        for (const int i : side.sent)
          {
            const std::size_t begin = rows.start[at(i)],
                              n     = rows.start[at(i) + 1] - begin;
            pack(i,
                 rows.column.data() + begin,
                 n,
                 rows.block(begin).data(),
                 n * rows.block_size,
                 lists[at(side.rank)]);
          }
      lists = processes.exchange(lists);
      for (const std::vector<int> &list : lists)
        unpack<float>(list,
                      rows.block_size,
                      [&](const int,
                          const int        *columns,
                          const std::size_t n,
                          const float      *values) {
                        rows.column.insert(rows.column.end(),
                                           columns,
                                           columns + n);
                        rows.value.insert(rows.value.end(),
                                          values,
                                          values + n * rows.block_size);
                        rows.start.push_back(rows.column.size());
                      });
    }

    /** Makes it the next row of a matrix. */
    template <int n_rows, int n_columns, typename Number>
    void
    append(const GrowingRow<n_rows, n_columns>    &row,
           BlockMatrix<n_rows, n_columns, Number> &A)
    {
      row.append_to(A.column, A.value);
      A.start.push_back(A.column.size());
    }

    /** A few more numbers than blocks have: columns are read in fours. */
    template <typename Matrix>
    void
    finish(Matrix &A)
    {
      A.value.resize(A.value.size() + 8);
    }

    /** Modes of each aggregate, orthogonal; and what they are made of. */
    template <int size, int coarse>
    BlockMatrix<size, coarse, float>
    orthogonal_modes(const std::vector<int> &aggregate_of,
                     const int               n_aggregates,
                     const int               begin,
                     const Eigen::MatrixXd  &modes,
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
              modes.middleRows<size>(Eigen::Index(own[k]) * size);
          Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(B);
          qr.setThreshold(same);
          const Eigen::Index rank = qr.rank();
          Eigen::MatrixXd    Q    = Eigen::MatrixXd::Zero(B.rows(), coarse);
          Q.leftCols(rank) =
            qr.householderQ() * Eigen::MatrixXd::Identity(B.rows(), rank);
          coarse_modes.middleRows<coarse>(Eigen::Index(a) * coarse) =
            Q.transpose() * B;
          for (std::size_t k = 0; k < own.size(); ++k)
            {
              T.column[at(own[k])] = begin + a;
              T.block(at(own[k]))  = Q.middleRows<size>(Eigen::Index(k) * size)
                                      .template cast<float>();
            }
        }
      T.value.resize(T.column.size() * T.block_size);
      return T;
    }

    /** One step of Jacobi's method: T - omega D A T. */
    template <int size, int coarse>
    BlockMatrix<size, coarse, float>
    smoothed(const LevelAbove<size>          &above,
             BlockMatrix<size, coarse, float> T,
             const Communicator              &processes)
    {
      append_rows_of_others(above.A, processes, T);
      const double omega =
        4. / 3 / static_cast<double>(above.largest) / above.unit;
      BlockMatrix<size, coarse, float> P;
      GrowingRow<size, coarse>         row;
      for (std::size_t i = 0; i < above.A.own_part().n_block_rows(); ++i)
        {
          row.clear();
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

    /** Own rows of P^T A P; those of aggregates of others are sent to them. */
    template <int size, int coarse>
    BlockMatrix<coarse, coarse, double>
    project(const LevelAbove<size>          &above,
            BlockMatrix<size, coarse, float> P,
            const std::vector<int>          &first,
            const Communicator              &processes)
    {
      using Map         = Eigen::Matrix<double, size, coarse>;
      const auto &A     = above.A;
      const int   n     = static_cast<int>(A.own_part().n_block_rows());
      const int   begin = first[at(processes.rank())],
                end     = first[at(processes.rank()) + 1];
      append_rows_of_others(A, processes, P);
      std::vector<GrowingRow<coarse, coarse>>   own(at(end - begin));
      std::map<int, GrowingRow<coarse, coarse>> others;
      GrowingRow<size, coarse>                  AP;
      for (int i = 0; i < n; ++i)
        {
          AP.clear();
          A.for_row(at(i), [&](const int j, const auto &a) {
            for (std::size_t k = P.start[at(j)]; k < P.start[at(j) + 1]; ++k)
              AP[P.column[k]].noalias() +=
                a * P.block(k).template cast<double>();
          });
          for (std::size_t k = P.start[at(i)]; k < P.start[at(i) + 1]; ++k)
            {
              const int a = P.column[k];
              auto     &row =
                a >= begin && a < end ? own[at(a - begin)] : others[a];
              const Map p = P.block(k).template cast<double>() / above.unit;
              for (std::size_t l = 0; l < AP.column.size(); ++l)
                row[AP.column[l]].noalias() += p.transpose() * AP.block[l];
            }
        }
      if (processes.size() > 1)
        {
          std::vector<std::vector<int>> lists(at(processes.size()));
          for (const auto &[a, row] : others)
            {
              const auto owner =
                std::upper_bound(first.begin(), first.end(), a) -
                first.begin() - 1;
              pack(a,
                   row.column.data(),
                   row.column.size(),
                   row.block.data()->data(),
                   row.column.size() * coarse * coarse,
                   lists[static_cast<std::size_t>(owner)]);
            }
          for (const std::vector<int> &list : processes.exchange(lists))
            unpack<double>(
              list,
              coarse * coarse,
              [&](const int         a,
                  const int        *columns,
                  const std::size_t n_columns,
                  const double     *values) {
                for (std::size_t k = 0; k < n_columns; ++k)
                  own[at(a - begin)][columns[k]] +=
                    Eigen::Map<const Eigen::Matrix<double, coarse, coarse>>(
                      values + k * coarse * coarse);
              });
        }
      BlockMatrix<coarse, coarse, double> result;
      for (auto &row : own)
        {
          append(row, result);
          row = {};
        }
      finish(result);
      return result;
    }
  } // namespace



  template <int size, int coarse>
  CoarseLevel<size, coarse>
  aggregate(const LevelAbove<size> &above, const Communicator &processes)
  {
    CoarseLevel<size, coarse> level;
    int                       n_own        = 0;
    const std::vector<int>    aggregate_of = group(above.A, n_own);
    level.rows.first                       = number(n_own, processes);
    level.P                                = smoothed(
      above,
      orthogonal_modes<size, coarse>(aggregate_of,
                                     n_own,
                                     level.rows.first[at(processes.rank())],
                                     above.modes,
                                     level.rows.modes),
      processes);
    level.rows.A = project(above, level.P, level.rows.first, processes);
    finish(level.P);
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
} // namespace conetact::backends
