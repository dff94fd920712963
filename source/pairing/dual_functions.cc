// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/dual_functions.h"

#include <Eigen/Eigenvalues>

namespace conetact::pairing
{
  Eigen::MatrixXd
  dual_functions(const Eigen::MatrixXd &mass, const Eigen::VectorXd &areas)
  {
    // Least over largest eigenvalue of the functions, each over its own size:
    // 1/9 on a square, 1/22 on one half of it, 1/67 in a corner, 1/144 on the
    // quarter in its middle. Below a thousandth a function would reach ten
    // times as far as what is covered.
    constexpr double least = 1e-3;

    const Eigen::Index    n    = areas.size();
    const Eigen::MatrixXd one  = Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd size = mass.diagonal().cwiseSqrt();
    if (!(size.minCoeff() > 0))
      return one;
    const Eigen::MatrixXd scaled = size.cwiseInverse().asDiagonal() * mass *
                                   size.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
    const Eigen::VectorXd &values = eigen.eigenvalues();
    if (!(values[0] > least * values[n - 1]))
      return one;
    const Eigen::MatrixXd inverse = eigen.eigenvectors() *
                                    values.cwiseInverse().asDiagonal() *
                                    eigen.eigenvectors().transpose();
    return areas.cwiseQuotient(size).asDiagonal() * inverse *
           size.cwiseInverse().asDiagonal();
  }
} // namespace conetact::pairing
