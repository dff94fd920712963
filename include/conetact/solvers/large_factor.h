// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_large_factor_h
#define conetact_solvers_large_factor_h

#include <Eigen/Dense>
#include <Eigen/SparseLU>

#include <vector>

namespace conetact::solvers
{
  /**
   * LU factors of matrices of one pattern, given as sparse ones: sparse factors
   * where they save work, else dense ones by LAPACK, which is many times faster
   * for each operation.
   */
  class LargeFactor
  {
  public:
    using Matrix = Eigen::SparseMatrix<double>;

    /** False if the matrix is singular. */
    bool
    factorize(const Matrix &A);

    Eigen::VectorXd
    solve(const Eigen::VectorXd &b) const;

    /** The pattern of the next matrix is a new one. */
    void
    forget_pattern()
    {
      analysed = false;
    }

  private:
    bool
    factorize_densely(const Matrix &A);

    Eigen::SparseLU<Matrix, Eigen::AMDOrdering<int>> sparse;
    Eigen::MatrixXd                                  dense;
    std::vector<int>                                 pivots;
    bool                                             analysed = false;
  };
} // namespace conetact::solvers

#endif
