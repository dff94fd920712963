// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/null_space.h"

#include "conetact/solvers/column_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    /** P^T A P = [L; M] [L; M]^T + (what is below the tolerance), L triangular
     * of size rank. The largest pivot comes first, so that what is left of A is
     * no larger than the last one. */
    struct PivotedCholesky
    {
      Eigen::MatrixXd                          factor; ///< n x rank
      Eigen::PermutationMatrix<Eigen::Dynamic> order;
      Eigen::Index                             rank = 0;
    };



    PivotedCholesky
    factorize(Eigen::MatrixXd A, const double tolerance)
    {
      const Eigen::Index n = A.rows();
      PivotedCholesky    result;
      result.order.setIdentity(n);
      auto &order = result.order.indices();
      for (; result.rank < n; ++result.rank)
        {
          const Eigen::Index k    = result.rank;
          Eigen::Index       best = 0;
          if (A.diagonal().tail(n - k).maxCoeff(&best) <= tolerance)
            break;
          best += k;
          if (best != k)
            {
              A.row(k).swap(A.row(best));
              A.col(k).swap(A.col(best));
              std::swap(order[k], order[best]);
            }
          const Eigen::Index m = n - k - 1;
          A.col(k).tail(m + 1) /= std::sqrt(A(k, k));
          A.bottomRightCorner(m, m).selfadjointView<Eigen::Lower>().rankUpdate(
            A.col(k).tail(m), -1.);
          // both triangles are kept for the exchanges
          for (Eigen::Index j = k + 1; j < n; ++j)
            A.row(j).tail(n - j) = A.col(j).tail(n - j).transpose();
        }
      result.factor = A.leftCols(result.rank);
      return result;
    }



    /** An orthonormal basis of the span of columns of about the same length. */
    Eigen::MatrixXd
    basis_of_span(const Eigen::MatrixXd &columns, const double tolerance)
    {
      if (columns.rows() == 0)
        return Eigen::MatrixXd(0, 0);
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
      qr.setThreshold(tolerance);
      return qr.householderQ() *
             Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
    }
  } // namespace



  Eigen::MatrixXd
  orthonormal_basis(const Eigen::MatrixXd &columns, const double tolerance)
  {
    eigen_assert(tolerance > 0);
    if (columns.cols() == 0)
      return columns;
    // columns of different units (translations, rotations) count alike
    Eigen::MatrixXd scaled = columns;
    for (Eigen::Index j = 0; j < scaled.cols(); ++j)
      if (scaled.col(j).squaredNorm() > 0)
        scaled.col(j).normalize();
    // Columns of one group see nothing of the others.
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(scaled.rows(), scaled.cols());
    Eigen::Index    rank  = 0;
    for (const ColumnGroup &group : column_groups(scaled))
      {
        const Eigen::MatrixXd own =
          basis_of_span(scaled(group.blocks, group.columns), tolerance);
        basis(group.blocks, Eigen::seqN(rank, own.cols())) = own;
        rank += own.cols();
      }
    return basis.leftCols(rank);
  }



  Eigen::MatrixXd
  null_space_basis(const Eigen::MatrixXd &K,
                   const Eigen::MatrixXd &known,
                   const double           tolerance)
  {
    eigen_assert(K.rows() == K.cols());
    eigen_assert(tolerance > 0);
    // Entries below of_rounding times what K G is, though it should be zero,
    // are rounding, too; motions that differ from known ones by less than
    // `same` of themselves are these.
    constexpr double   of_rounding = 1e3, same = 1e-6;
    const Eigen::Index n    = K.rows();
    const double       zero = tolerance * tolerance * K.diagonal().maxCoeff();
    const Eigen::MatrixXd G = orthonormal_basis(known);
    // K G would be zero, and shows what K is known to.
    Eigen::VectorXd rounding = Eigen::VectorXd::Zero(n);
    if (G.cols() > 0)
      rounding = of_rounding * (K * G).cwiseAbs().rowwise().maxCoeff();
    const Eigen::VectorXd scale =
      K.diagonal().binaryExpr(rounding, [zero](const double d, const double r) {
        return d > std::max(zero, r) ? 1 / std::sqrt(d) : 0.;
      });
    const Eigen::MatrixXd scaled = scale.asDiagonal() * K * scale.asDiagonal();

    const PivotedCholesky cholesky = factorize(scaled, tolerance);
    const Eigen::Index    rank = cholesky.rank, k = n - rank;
    if (k == 0 && G.cols() == 0)
      return Eigen::MatrixXd(n, 0);
    if (k <= G.cols()) // what is known is known to the last digit
      return G;
    if (rank == 0)
      return Eigen::MatrixXd::Identity(n, n);
    const auto L = cholesky.factor.topRows(rank).triangularView<Eigen::Lower>();

    // [L; M] [L; M]^T (-L^-T M^T; I) = 0
    Eigen::MatrixXd basis(n, k);
    basis.bottomRows(k).setIdentity();
    basis.topRows(rank) =
      -L.transpose().solve(cholesky.factor.bottomRows(k).transpose());
    // one step of refinement with the leading block
    const Eigen::MatrixXd permuted =
      cholesky.order.transpose() * scaled * cholesky.order;
    Eigen::MatrixXd residual = permuted.topRows(rank) * basis;
    L.solveInPlace(residual);
    L.transpose().solveInPlace(residual);
    basis.topRows(rank) -= residual;

    basis = cholesky.order * basis;
    // entries without any stiffness move freely
    for (Eigen::Index i = 0; i < n; ++i)
      basis.row(i) *= scale[i] > 0 ? scale[i] : 1.;
    basis = orthonormal_basis(basis, 1e-14);
    if (G.cols() == 0)
      return basis;
    Eigen::MatrixXd all(n, G.cols() + k);
    all << G, basis;
    return orthonormal_basis(all, same);
  }
} // namespace conetact::solvers
