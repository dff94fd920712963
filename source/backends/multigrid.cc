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
      return Eigen::Map<const Eigen::MatrixXd>(processes.gather_all(A).data(),
                                               n,
                                               n)
        .transpose();
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
            D[i] = A.block(k)
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
    P = {gather_blocks<fine, coarse>(levels.size(0) / fine,
                                     [&](const int i, SparseRow &r) {
                                       levels.prolongator_row(1, i, r);
                                     }),
         over(levels.first(1), coarse),
         processes};
    R = {P, at(levels.size(1) / coarse)};
    below.resize(at(n - 1));
    for (int l = 1; l < n; ++l)
      make_level(levels, l);
    coarsest.compute(dense(levels, n - 1, processes));
    first_coarsest = levels.first(n - 1)[at(processes.rank())];
  }



  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::make_level(const SmoothedAggregation &levels,
                                         const int                  l)
  {
    Level    &level  = below[at(l - 1)];
    const int blocks = levels.size(l) / coarse;
    for (FloatVector *v : {&level.b, &level.r, &level.x, &level.c})
      v->setZero(levels.size(l));
    if (l + 1 == levels.n_levels())
      return;
    level.A       = {gather_blocks<coarse, coarse>(blocks,
                                             [&](const int i, SparseRow &r) {
                                               levels.matrix_row(l, i, r);
                                             }),
                     over(levels.first(l), coarse),
                     processes};
    level.D       = inverse_diagonal(level.A.own_part());
    level.P       = {gather_blocks<coarse, coarse>(blocks,
                                             [&](const int i, SparseRow &r) {
                                               levels.prolongator_row(l + 1,
                                                                      i,
                                                                      r);
                                             }),
                     over(levels.first(l + 1), coarse),
                     processes};
    level.R       = {level.P, at(levels.size(l + 1) / coarse)};
    level.largest = largest_eigenvalue(
      [&](const FloatVector &x, FloatVector &y) {
        level.A.multiply(x.data(), y.data());
      },
      [&](const FloatVector &x, FloatVector &y) {
        multiply_blocks(level.D, x, y);
      },
      levels.first(l)[at(processes.rank())],
      level.b.size(),
      processes);
  }



  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::correct(const FloatVector &r, FloatVector &x)
  {
    R.multiply(r.data(), below[0].b.data());
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
        const Eigen::VectorXd b =
          processes.gather_all(level.b).template cast<double>();
        const Eigen::VectorXd x = coarsest.solve(b);
        level.x =
          x.segment(first_coarsest, level.b.size()).template cast<float>();
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
    level.R.multiply(level.r.data(), below[l + 1].b.data());
    cycle(l + 1);
    level.P.multiply(below[l + 1].x.data(), level.c.data());
    level.x += level.c;
    smoother.smooth_last(level.b, level.r, level.x);
  }

  template class CoarseLevels<2, 3>;
  template class CoarseLevels<3, 6>;
} // namespace conetact::backends
