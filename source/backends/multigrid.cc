// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/multigrid.h"

#include <Eigen/LU>

#include <algorithm>

namespace conetact::backends
{
  namespace
  {
    std::size_t
    at(const int i)
    {
      return static_cast<std::size_t>(i);
    }

    /** Unknowns of a level of which each process has all. */
    constexpr int few = 4000;

    /** A matrix of blocks from rows of entries. */
    template <int n_rows, int n_columns, typename RowOf>
    BlockMatrix<n_rows, n_columns, float>
    gather_blocks(const int n, const RowOf &row_of)
    {
      BlockMatrix<n_rows, n_columns, float> A;
      SparseRow                             rows[n_rows];
      std::vector<int>                      columns;
      for (int i = 0; i < n; ++i)
        {
          columns.clear();
          for (int r = 0; r < n_rows; ++r)
            {
              row_of(n_rows * i + r, rows[r]);
              for (const int c : rows[r].columns)
                columns.push_back(c / n_columns);
            }
          std::sort(columns.begin(), columns.end());
          columns.erase(std::unique(columns.begin(), columns.end()),
                        columns.end());
          const std::size_t first = A.start.back();
          A.start.push_back(first + columns.size());
          A.column.insert(A.column.end(), columns.begin(), columns.end());
          A.value.resize(A.start.back() * A.block_size, 0.f);
          for (int r = 0; r < n_rows; ++r)
            for (std::size_t k = 0; k < rows[r].columns.size(); ++k)
              {
                const int  c     = rows[r].columns[k];
                const auto place = std::lower_bound(columns.begin(),
                                                    columns.end(),
                                                    c / n_columns) -
                                   columns.begin();
                A.block(first +
                        static_cast<std::size_t>(place))(r, c % n_columns) =
                  static_cast<float>(rows[r].values[k]);
              }
        }
      // columns are read in fours
      A.value.resize(A.value.size() + 8, 0.f);
      return A;
    }

    /** The rows of all processes. */
    template <int n_rows, int n_columns>
    BlockMatrix<n_rows, n_columns, float>
    all_rows(BlockMatrix<n_rows, n_columns, float> own,
             const Communicator                   &processes)
    {
      if (processes.size() == 1)
        return own;
      using Ints   = Eigen::VectorXi;
      using Floats = Eigen::VectorXf;
      const auto n = static_cast<Eigen::Index>(own.column.size());
      Ints       lengths(own.n_block_rows());
      for (std::size_t i = 0; i < own.n_block_rows(); ++i)
        lengths[static_cast<Eigen::Index>(i)] =
          static_cast<int>(own.start[i + 1] - own.start[i]);
      BlockMatrix<n_rows, n_columns, float> all;
      for (const int length : processes.gather_all(lengths))
        all.start.push_back(all.start.back() + at(length));
      all.allocate();
      const Ints columns =
        processes.gather_all(Ints(Eigen::Map<Ints>(own.column.data(), n)));
      std::copy(columns.begin(), columns.end(), all.column.begin());
      const Floats values = processes.gather_all(
        Floats(Eigen::Map<Floats>(own.value.data(), n * n_rows * n_columns)));
      std::copy(values.begin(), values.end(), all.value.begin());
      return all;
    }

    /** Of the rows of all processes. */
    Eigen::MatrixXd
    dense(const SmoothedAggregation &levels,
          const int                  level,
          const Communicator        &processes)
    {
      const int       n   = levels.first(level).back();
      const int       own = levels.size(level);
      Eigen::VectorXd A   = Eigen::VectorXd::Zero(Eigen::Index(own) * n);
      SparseRow       row;
      for (int i = 0; i < own; ++i)
        {
          levels.matrix_row(level, i, row);
          for (std::size_t k = 0; k < row.columns.size(); ++k)
            A(Eigen::Index(i) * n + row.columns[k]) = row.values[k];
        }
      A = processes.gather_all(A);
      return Eigen::Map<const Eigen::MatrixXd>(A.data(), n, n).transpose();
    }

    /** Numbers of blocks from those of unknowns. */
    std::vector<int>
    over(std::vector<int> first, const int size)
    {
      for (int &i : first)
        i /= size;
      return first;
    }

    /** Inverse diagonal blocks of a matrix. */
    template <int size>
    std::vector<Eigen::Matrix<float, size, size>>
    inverse_diagonal(const BlockMatrix<size, size, float> &A)
    {
      std::vector<Eigen::Matrix<float, size, size>> D(A.n_block_rows());
      for (std::size_t i = 0; i < D.size(); ++i)
        for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
          if (static_cast<std::size_t>(A.column[k]) == i)
            D[i] = A.block(i, k)
                     .template cast<double>()
                     .completeOrthogonalDecomposition()
                     .pseudoInverse()
                     .template cast<float>();
      return D;
    }
  } // namespace



  template <int fine, int coarse>
  CoarseLevels<fine, coarse>::CoarseLevels(const SmoothedAggregation &levels,
                                           const Communicator        &p)
    : processes(p)
  {
    const int n = levels.n_levels();
    if (n < 2)
      return;
    below.resize(at(n - 1));
    for (int l = 1; l < n; ++l)
      {
        Level &level   = below[at(l - 1)];
        level.is_whole = l + 1 == n || levels.first(l).back() <= few;
        level.is_first_whole =
          level.is_whole && (l == 1 || !below[at(l - 2)].is_whole);
        const int size =
          level.is_whole ? levels.first(l).back() : levels.size(l);
        for (FloatVector *v : {&level.b, &level.r, &level.x, &level.c})
          v->setZero(size);
      }
    P = prolongator<fine>(levels, 1);
    R = {P, static_cast<std::size_t>(below[0].b.size()) / coarse};
    for (int l = 1; l + 1 < n; ++l)
      make_level(levels, l);
    coarsest.compute(dense(levels, n - 1, processes));
  }



  template <int fine, int coarse>
  template <int size>
  DistributedMatrix<size, coarse, float>
  CoarseLevels<fine, coarse>::prolongator(const SmoothedAggregation &levels,
                                          const int                  l) const
  {
    auto rows = gather_blocks<size, coarse>(levels.size(l - 1) / size,
                                            [&](const int i, SparseRow &r) {
                                              levels.prolongator_row(l, i, r);
                                            });
    if (l > 1 && below[at(l - 2)].is_whole)
      rows = all_rows(std::move(rows), processes);
    return {std::move(rows),
            over(levels.first(l), coarse),
            sharers(below[at(l - 1)])};
  }



  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::make_level(const SmoothedAggregation &levels,
                                         const int                  l)
  {
    Level             &level = below[at(l - 1)];
    const Communicator own   = sharers(level);
    auto rows = gather_blocks<coarse, coarse>(levels.size(l) / coarse,
                                              [&](const int i, SparseRow &r) {
                                                levels.matrix_row(l, i, r);
                                              });
    if (level.is_whole)
      rows = all_rows(std::move(rows), processes);
    level.A       = {std::move(rows), over(levels.first(l), coarse), own};
    level.D       = inverse_diagonal(level.A.own_part());
    level.P       = prolongator<coarse>(levels, l + 1);
    level.R       = {level.P,
                     static_cast<std::size_t>(below[at(l)].b.size()) / coarse};
    level.largest = largest_eigenvalue(
      [&](const FloatVector &x, FloatVector &y) {
        level.A.multiply(x.data(), y.data());
      },
      [&](const FloatVector &x, FloatVector &y) {
        multiply_blocks(level.D, x, y);
      },
      level.is_whole ? 0 : levels.first(l)[at(own.rank())],
      level.b.size(),
      own);
  }



  /* What each process has of the residual makes a part of the whole. */
  template <int fine, int coarse>
  template <typename Matrix>
  void
  CoarseLevels<fine, coarse>::restrict_to(Level             &level,
                                          const Matrix      &restriction,
                                          const FloatVector &r)
  {
    restriction.multiply(r.data(), level.b.data());
    if (level.is_first_whole)
      processes.sum(level.b.data(), level.b.size());
  }



  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::correct(const FloatVector &r, FloatVector &x)
  {
    restrict_to(below[0], R, r);
    cycle(0);
    P.multiply(below[0].x.data(), x.data());
  }



  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::cycle(const std::size_t l)
  {
    Level &level = below[l];
    if (l + 1 == below.size())
      {
        level.x = coarsest.solve(level.b.template cast<double>())
                    .template cast<float>();
        return;
      }
    const auto multiply = [&](const FloatVector &x, FloatVector &y) {
      level.A.multiply(x.data(), y.data());
    };
    const auto scale = [&](const FloatVector &x, FloatVector &y) {
      multiply_blocks(level.D, x, y);
    };
    Chebyshev smoother(multiply, scale, level.largest);
    level.r = level.b;
    smoother.smooth_first(level.r, level.x);
    restrict_to(below[l + 1], level.R, level.r);
    cycle(l + 1);
    level.P.multiply(below[l + 1].x.data(), level.c.data());
    level.x += level.c;
    smoother.smooth_last(level.b, level.r, level.x);
  }

  template class CoarseLevels<2, 3>;
  template class CoarseLevels<3, 6>;
} // namespace conetact::backends
