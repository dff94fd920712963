// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/large_factor.h"

#include <lapacke.h>

namespace conetact::solvers
{
  namespace
  {
    /* Share of entries from which a dense factorisation is faster: fill makes
       the factors of such a matrix nearly full. */
    constexpr double dense_from = .04;
  } // namespace



  bool
  LargeFactor::factorize_densely(const Matrix &A)
  {
    dense        = A;
    const auto n = static_cast<lapack_int>(A.rows());
    pivots.resize(static_cast<std::size_t>(n));
    return LAPACKE_dgetrf_work(
             LAPACK_COL_MAJOR, n, n, dense.data(), n, pivots.data()) == 0;
  }



  /* Dense factors have partial pivots and 2 n^3 / 3 operations whatever the
     pattern; only an exact zero is singular to LAPACK, so that who calls looks
     at the result. */
  bool
  LargeFactor::factorize(const Matrix &A)
  {
    eigen_assert(A.rows() == A.cols());
    const auto   n    = static_cast<double>(A.rows());
    const double fill = static_cast<double>(A.nonZeros()) / (n * n);
    dense.resize(0, 0);
    if (fill > dense_from)
      return factorize_densely(A);
    if (!analysed)
      sparse.analyzePattern(A);
    analysed = true;
    sparse.factorize(A);
    return sparse.info() == Eigen::Success;
  }



  Eigen::VectorXd
  LargeFactor::solve(const Eigen::VectorXd &b) const
  {
    eigen_assert(b.size() == (dense.size() > 0 ? dense.rows() : sparse.rows()));
    if (dense.size() == 0)
      return sparse.solve(b);
    Eigen::VectorXd x = b;
    const auto      n = static_cast<lapack_int>(b.size());
    LAPACKE_dgetrs_work(
      LAPACK_COL_MAJOR, 'N', n, 1, dense.data(), n, pivots.data(), x.data(), n);
    return x;
  }
} // namespace conetact::solvers
