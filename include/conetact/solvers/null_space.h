// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_null_space_h
#define conetact_solvers_null_space_h

#include <Eigen/Dense>

namespace conetact::solvers
{
  /**
   * Orthonormal basis (columns) of the null space of a symmetric positive
   * semidefinite matrix K, by Cholesky factorisation with complete pivoting of
   * @f$D^{-1/2} K D^{-1/2}@f$, D the diagonal of K: rigid motions and
   * mechanisms nobody has named. The scaling makes the rank independent of
   * units and of stiff and soft bodies side by side. A pivot below `tolerance`
   * (without units) counts as zero, as do diagonal entries that rounding may
   * have left: the columns of `known` are motions without strain, for which
   * K gives nothing else. Costs n^3/3 operations at most; meant for sizes up
   * to about a thousand.
   */
  Eigen::MatrixXd
  null_space_basis(const Eigen::MatrixXd &K,
                   const Eigen::MatrixXd &known     = {},
                   const double           tolerance = 1e-11);

  /**
   * Orthonormal basis of the span of the columns; those that depend on the
   * others up to `tolerance` are dropped.
   */
  Eigen::MatrixXd
  orthonormal_basis(const Eigen::MatrixXd &columns,
                    const double           tolerance = 1e-10);
} // namespace conetact::solvers

#endif
