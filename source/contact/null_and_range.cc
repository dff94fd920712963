// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/null_and_range.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace conetact::contact
{
  namespace
  {
    /** Eigenvalues of a sum of squares below this part of the largest are 0:
     * directions below a millionth. */
    constexpr double rank_limit = 1e-12;
  } // namespace



  /* V_0 with gram V_0 = 0, and V, the pseudo-inverse V L^-1 V^T: of a matrix of
     few rows, so that all eigenvalues are asked for. */
  NullAndRange
  split(const Eigen::MatrixXd &gram)
  {
    NullAndRange result{gram, gram, gram};
    if (gram.rows() == 0)
      return result;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
    // At least over 1, the square of a direction: where nothing is held the
    // largest eigenvalue is 0.
    const double limit =
      rank_limit * std::max(1., eigen.eigenvalues().maxCoeff());
    Eigen::Index n_null = 0;
    while (n_null < gram.rows() && eigen.eigenvalues()[n_null] < limit)
      ++n_null;
    const Eigen::Index    rank = gram.rows() - n_null;
    const Eigen::MatrixXd V    = eigen.eigenvectors().rightCols(rank);
    result.null                = eigen.eigenvectors().leftCols(n_null);
    result.range               = V;
    // Without the free motions: of all placements that fit the supports the
    // smallest.
    result.pseudo_inverse =
      V * eigen.eigenvalues().tail(rank).cwiseInverse().asDiagonal() *
      V.transpose();
    return result;
  }
} // namespace conetact::contact
