// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/bound_unknowns.h"

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /** Pivots of rows scaled to one: below, others imply the row. */
    constexpr double least_pivot = 1e-11;

    /** Over the largest flexibility, and of motions, which are about one: what
     * is less is rounding. */
    constexpr double least_flexibility = 1e-14, least_motion = 1e-10;

    /** BLAS does not take a matrix without rows, and says so. */
    Eigen::VectorXd
    times(const Eigen::MatrixXd &A, const Eigen::VectorXd &x)
    {
      return A.rows() > 0 ? Eigen::VectorXd(A * x) : Eigen::VectorXd();
    }

    Eigen::VectorXd
    transposed_times(const Eigen::MatrixXd &A, const Eigen::VectorXd &x)
    {
      return A.rows() > 0 ? Eigen::VectorXd(A.transpose() * x) :
                            Eigen::VectorXd::Zero(A.cols());
    }

    /** An orthonormal basis of the columns. */
    Eigen::MatrixXd
    basis_of(const Eigen::MatrixXd &columns)
    {
      if (columns.cols() == 0)
        return columns;
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
      qr.setThreshold(1e-10);
      return qr.householderQ() *
             Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
    }

    /**
     * Rows of a positive semidefinite matrix of unit diagonal that are
     * independent: Cholesky with pivots.
     */
    std::vector<Eigen::Index>
    independent_rows(Eigen::MatrixXd S)
    {
      std::vector<Eigen::Index> rows;
      const Eigen::Index        n = S.rows();
      Eigen::MatrixXd           L(n, n);
      Eigen::VectorXd           left = S.diagonal();
      for (Eigen::Index k = 0; k < n; ++k)
        {
          Eigen::Index pivot = 0;
          if (!(left.maxCoeff(&pivot) > least_pivot))
            break;
          L.col(k) = S.col(pivot);
          L.col(k).noalias() -=
            L.leftCols(k) * L.row(pivot).head(k).transpose();
          L.col(k) /= std::sqrt(left[pivot]);
          left -= L.col(k).cwiseAbs2();
          left[pivot] = -1; // taken
          rows.push_back(pivot);
        }
      std::sort(rows.begin(), rows.end());
      return rows;
    }
  } // namespace

  /* Scaled to a unit diagonal, soft and stiff bodies count alike; of the
     motions it matters only which of them the rows see. */
  void
  BoundUnknowns::choose_rows(const MatrixXd &W, const MatrixXd &G)
  {
    const Index  n = W.rows();
    const double rounding =
      n > 0 ? least_flexibility * W.diagonal().maxCoeff() : 0.;
    VectorXd size(n);
    for (Index i = 0; i < n; ++i)
      size[i] = W(i, i) > rounding             ? 1 / std::sqrt(W(i, i)) :
                G.row(i).norm() > least_motion ? 1 / G.row(i).norm() :
                                                 0.;
    MatrixXd       S = size.asDiagonal() * W * size.asDiagonal();
    const MatrixXd Q = basis_of(size.asDiagonal() * G);
    S += Q * Q.transpose();
    // what neither strains nor moves has rounding on the diagonal
    VectorXd diagonal = VectorXd::Zero(n);
    for (Index i = 0; i < n; ++i)
      if (size[i] > 0 && S(i, i) > 0)
        diagonal[i] = 1 / std::sqrt(S(i, i));
    rows = independent_rows(diagonal.asDiagonal() * S * diagonal.asDiagonal());
    scaling.resize(static_cast<Index>(rows.size()) + G.cols());
    scaling << size(rows), VectorXd::Ones(G.cols());
  }

  BoundUnknowns::BoundUnknowns(const MatrixXd &all,
                               const Index     n_c,
                               const Index     n_t,
                               const MatrixXd &free,
                               const MatrixXd &tied)
    : n_contact(n_c)
    , n_bound(n_t)
    , N(free)
    , M(tied)
  {
    const Index    k   = all.cols() - n_c - n_t;
    const MatrixXd G   = all.topRightCorner(n_c + n_t, k);
    const MatrixXd C   = all.bottomRightCorner(k, k);
    const MatrixXd G_M = G.bottomRows(n_t) * M;
    choose_rows(all.block(n_c, n_c, n_t, n_t), G_M);

    const auto  n_rows = static_cast<Index>(rows.size());
    const Index n_e = n_rows + M.cols(), n_k = n_c + N.cols();
    for (Index j = 0; j < M.cols(); ++j)
      if (const double size =
            (scaling.head(n_rows).asDiagonal() * G_M(rows, j)).norm();
          size > 0)
        scaling[n_rows + j] = 1 / size;
    sign.resize(n_k + n_e);
    sign << VectorXd::Ones(n_c), -VectorXd::Ones(N.cols()),
      VectorXd::Ones(n_rows), -VectorXd::Ones(M.cols());

    // Only what foundations resist strains a tie; the rest is rounding.
    MatrixXd       G_N = G * N;
    const MatrixXd C_N = C * N;
    for (Index j = 0; j < N.cols(); ++j)
      if (C_N.col(j).isZero(0))
        G_N.col(j).tail(n_t).setZero();

    MatrixXd       bound(n_e, n_e), coupling(n_e, n_k); // of what stays
    const MatrixXd W_t = all.block(n_c, 0, n_t, n_c + n_t)(rows, Eigen::all);
    const MatrixXd G_t = G_M(rows, Eigen::all);
    bound << W_t.rightCols(n_t)(Eigen::all, rows), G_t, -G_t.transpose(),
      M.transpose() * C * M;
    coupling << W_t.leftCols(n_c), G_N.bottomRows(n_t)(rows, Eigen::all),
      -(G.topRows(n_c) * M).transpose(), M.transpose() * C_N;
    if (n_e > 0)
      factor.compute(scaling.asDiagonal() * bound * scaling.asDiagonal());
    answer = n_e > 0 ? MatrixXd(scaling.asDiagonal() *
                                factor.solve(scaling.asDiagonal() * coupling)) :
                       coupling;

    kept.resize(n_k, n_k);
    kept << all.topLeftCorner(n_c, n_c), G_N.topRows(n_c),
      -G_N.topRows(n_c).transpose(), N.transpose() * C_N;
    // The coupling the other way round is the same but for signs.
    kept -= sign.head(n_k).asDiagonal() * coupling.transpose() *
            sign.tail(n_e).asDiagonal() * answer;
    // and both triangles are alike but for rounding and these signs
    const MatrixXd other = sign.head(n_k).asDiagonal() * kept.transpose() *
                           sign.head(n_k).asDiagonal();
    kept = .5 * (kept + other);
  }

  Eigen::VectorXd
  BoundUnknowns::bound_part(const VectorXd &load) const
  {
    VectorXd result(n_bound + M.cols());
    result << load.segment(n_contact, n_bound),
      transposed_times(M, load.tail(M.rows()));
    return result;
  }

  Eigen::VectorXd
  BoundUnknowns::kept_part(const VectorXd &load) const
  {
    VectorXd result(n_contact + N.cols());
    result << load.head(n_contact), transposed_times(N, load.tail(N.rows()));
    return result;
  }

  Eigen::VectorXd
  BoundUnknowns::chosen_part(const VectorXd &bound_load) const
  {
    VectorXd result(scaling.size());
    result << bound_load(rows), bound_load.tail(M.cols());
    return result;
  }

  Eigen::VectorXd
  BoundUnknowns::effect(const VectorXd &bound_load) const
  {
    const Index n_k = answer.cols();
    return -(sign.head(n_k).asDiagonal() *
             transposed_times(answer,
                              sign.tail(answer.rows()).asDiagonal() *
                                chosen_part(bound_load)));
  }

  Eigen::VectorXd
  BoundUnknowns::bound_of(const VectorXd &unknowns,
                          const VectorXd &bound_load) const
  {
    VectorXd x = -times(answer, unknowns);
    if (x.size() > 0)
      x -= scaling.asDiagonal() *
           factor.solve(scaling.asDiagonal() * chosen_part(bound_load));
    VectorXd   result     = VectorXd::Zero(n_bound + M.rows());
    const auto n_rows     = static_cast<Index>(rows.size());
    result(rows)          = x.head(n_rows);
    result.tail(M.rows()) = times(M, x.tail(M.cols()));
    return result;
  }

  Eigen::VectorXd
  BoundUnknowns::complete(const VectorXd &unknowns,
                          const VectorXd &bound_load) const
  {
    const VectorXd bound = bound_of(unknowns, bound_load);
    VectorXd       result(n_contact + bound.size());
    result << unknowns.head(n_contact), bound;
    result.tail(N.rows()) += times(N, unknowns.tail(N.cols()));
    return result;
  }
} // namespace conetact::contact
