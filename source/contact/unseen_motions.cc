// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/unseen_motions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  /* Squares of rows are small and cheap, but know singular values to the root
     of rounding only: they choose motions that may be unseen (`nearly`), and
     the rows themselves tell which of these are (`zero`). */
  Eigen::MatrixXd
  forget_unseen(Eigen::MatrixXd &rows)
  {
    constexpr double zero = 1e-12, nearly = 1e-6;
    if (rows.size() == 0)
      return {rows.cols(), 0};
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> squares(
      rows.transpose() * rows);
    const Eigen::VectorXd &values = squares.eigenvalues();
    // Entries are about one, or all of them are rounding: where ties take every
    // motion that contacts would see.
    const double       most = std::max(1., std::sqrt(values.maxCoeff()));
    const Eigen::Index n =
      (values.array() <= std::pow(nearly * most, 2)).count();
    if (n == 0)
      return {rows.cols(), 0};
    const Eigen::MatrixXd near = squares.eigenvectors().leftCols(n);
    // Rows of zeros are added: a thin SVD has as many right vectors as columns
    // then.
    Eigen::MatrixXd seen      = Eigen::MatrixXd::Zero(rows.rows() + n, n);
    seen.topRows(rows.rows()) = rows * near;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(seen, Eigen::ComputeThinV);
    const Eigen::Index                      n_seen =
      (svd.singularValues().array() > zero * most).count();
    const Eigen::MatrixXd unseen = near * svd.matrixV().rightCols(n - n_seen);
    rows -= (rows * unseen).eval() * unseen.transpose();
    // What is left of a motion that nothing sees is rounding, which solvers
    // would take for a way to hold it.
    for (Eigen::Index j = 0; j < rows.cols(); ++j)
      if (rows.col(j).norm() <= zero * most)
        rows.col(j).setZero();
    return unseen;
  }
} // namespace conetact::contact
