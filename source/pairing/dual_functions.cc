// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/dual_functions.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

namespace conetact::pairing
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /**
     * The functions of kept nodes, rows B in terms of the N_k, which sum to 1:
     * each node's own one, and a share of those of nodes that are not kept, in
     * proportion to the integral of its own.
     */
    MatrixXd
    extended(const VectorXd &areas, const std::vector<Index> &kept)
    {
      const auto m = static_cast<Index>(kept.size());
      // Integrals of functions of second degree may be negative near a rim.
      const VectorXd own = areas(kept).cwiseMax(0.);
      const double   sum = own.sum();
      const VectorXd share =
        sum > 0 ? VectorXd(own / sum) :
                  VectorXd(VectorXd::Constant(m, 1. / static_cast<double>(m)));
      MatrixXd functions = share * VectorXd::Ones(areas.size()).transpose();
      for (const Index k : kept)
        functions.col(k).setZero();
      for (Index j = 0; j < m; ++j)
        functions(j, kept[static_cast<std::size_t>(j)]) = 1;
      return functions;
    }
  } // namespace

  MatrixXd
  dual_functions(const MatrixXd           &mass,
                 const VectorXd           &areas,
                 const std::vector<Index> &kept)
  {
    AssertDimension(mass.rows(), mass.cols());
    AssertDimension(areas.size(), mass.rows());
    // The least over the largest singular value of the functions, each over its
    // own size, is 1/9 on a square, 1/22 on one half of it, 1/67 in a corner,
    // 1/144 on the quarter in its middle. Below a thousandth a function would
    // reach ten times as far as what is covered.
    constexpr double least = 1e-3;

    // psi = C B N is dual to the kept N_k where C (B M)_kept = diag(a_kept),
    // with the mass M and the integrals a of the N_k; they sum to 1 as the
    // functions B do. B M is scaled by the L2 norms of both sets of functions
    // before it is inverted: then its singular values tell how much alike they
    // are, not how small the part is that is covered.
    const MatrixXd functions = extended(areas, kept);
    MatrixXd       all       = MatrixXd::Zero(areas.size(), areas.size());
    all(kept, Eigen::all)    = functions;
    // One function alone is 1 on all that is covered: it is dual to its own
    // node whatever the mass.
    if (kept.size() == 1)
      return all;
    const VectorXd own = mass.diagonal()(kept).cwiseSqrt();
    const VectorXd size =
      (functions * mass * functions.transpose()).diagonal().cwiseSqrt();
    if (!(own.minCoeff() > 0 && size.minCoeff() > 0))
      return all;
    const MatrixXd scaled = size.cwiseInverse().asDiagonal() *
                            (functions * mass)(Eigen::all, kept) *
                            own.cwiseInverse().asDiagonal();
    const Eigen::JacobiSVD<MatrixXd> svd(scaled,
                                         Eigen::ComputeFullU |
                                           Eigen::ComputeFullV);
    const VectorXd                  &values = svd.singularValues();
    // Functions that are too much alike stay as they are, not dual: D has
    // entries beside its diagonal then, but sums of forces and constant
    // pressures pass all the same, as the functions sum to 1.
    if (!(values[values.size() - 1] > least * values[0]))
      return all;
    const MatrixXd inverse = svd.matrixV() *
                             values.cwiseInverse().asDiagonal() *
                             svd.matrixU().transpose();
    all(kept, Eigen::all) = areas(kept).cwiseQuotient(own).asDiagonal() *
                            inverse * size.cwiseInverse().asDiagonal() *
                            functions;
    return all;
  }

  /* The linear functions are lambda_c = N_c + sum_m lambda_c(x_m) N_m over the
     nodes m in the middle (hierarchical basis). From int phi_j lambda_c =
     delta_jc int lambda_j and int phi_j N_m = int lambda_j N_m follow the other
     integrals, int phi_j N_c = delta_jc int lambda_j - sum_m lambda_c(x_m) int
     lambda_j N_m. */
  MatrixXd
  corner_integrals(const MatrixXd &of_linear, const MatrixXd &linear)
  {
    AssertDimension(of_linear.cols(), linear.cols());
    AssertDimension(of_linear.rows(), linear.rows());
    const Index n = linear.rows(), middles = linear.cols() - n;
    MatrixXd    integrals = of_linear;
    integrals.leftCols(n) =
      MatrixXd(of_linear.rowwise().sum().asDiagonal()) -
      of_linear.rightCols(middles) * linear.rightCols(middles).transpose();
    return integrals;
  }

  MatrixXd
  corner_functions(const MatrixXd &mass, const MatrixXd &linear)
  {
    AssertDimension(mass.rows(), linear.cols());
    const MatrixXd integrals = corner_integrals(linear * mass, linear);
    // phi_j = sum_k F_jk N_k with F M = integrals; the mass M is symmetric.
    return mass.ldlt().solve(integrals.transpose()).transpose();
  }
} // namespace conetact::pairing
