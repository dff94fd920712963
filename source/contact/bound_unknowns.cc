// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/bound_unknowns.h"

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    /** The rounding of flexibilities over the largest of them, and that of
     * entries of motions, which are about one. */
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
  } // namespace

  /* Factors D scale W_tt to a unit diagonal: soft and stiff bodies count alike
     when pivots are chosen. Rows without flexibility have the size of their
     motions. */
  Eigen::VectorXd
  BoundUnknowns::scales_of(const MatrixXd &W, const MatrixXd &G) const
  {
    const double rounding =
      W.rows() > 0 ? least_flexibility * W.diagonal().maxCoeff() : 0.;
    VectorXd size(static_cast<Index>(rows.size()));
    for (Index k = 0; k < size.size(); ++k)
      {
        const Index i = rows[static_cast<std::size_t>(k)];
        size[k]       = W(i, i) > rounding ? 1 / std::sqrt(W(i, i)) :
                        G.row(i).norm() > least_motion ? 1 / G.row(i).norm() :
                                                         1.;
      }
    return size;
  }

  BoundUnknowns::BoundUnknowns(const MatrixXd           &all,
                               const Index               n_c,
                               const Index               n_t,
                               const MatrixXd           &free,
                               const MatrixXd           &tied,
                               const std::vector<Index> &loose,
                               RedundantRows             held_twice)
    : n_contact(n_c)
    , n_bound(n_t)
    , N(free)
    , M(tied)
    , redundant(std::move(held_twice))
    , rows(redundant.independent)
  {
    // With x = (r_c, a_f) that stay, y = (r_t, a_t) that go and the matrices A
    // of x, E of y and B of x in the rows of y: y = -E^-1 (B x + load). Rows of
    // motions have the other sign, A^T = S A S with S = diag(1, -1), so that
    // the coupling of y in the rows of x is S B^T S, and A - S B^T S E^-1 B
    // remains.
    const Index    k      = all.cols() - n_c - n_t;
    const MatrixXd G      = all.topRightCorner(n_c + n_t, k);
    const MatrixXd C      = all.bottomRightCorner(k, k);
    const MatrixXd G_M    = G.bottomRows(n_t) * M;
    const auto     n_rows = static_cast<Index>(rows.size());
    scaling.resize(n_rows + M.cols());
    scaling << scales_of(all.block(n_c, n_c, n_t, n_t), G_M),
      VectorXd::Ones(M.cols());

    const Index n_e = n_rows + M.cols(), n_k = n_c + N.cols();
    for (Index j = 0; j < M.cols(); ++j)
      if (const double size =
            (scaling.head(n_rows).asDiagonal() * G_M(rows, j)).norm();
          size > 0)
        scaling[n_rows + j] = 1 / size;
    sign.resize(n_k + n_e);
    sign << VectorXd::Ones(n_c), -VectorXd::Ones(N.cols()),
      VectorXd::Ones(n_rows), -VectorXd::Ones(M.cols());

    // G_t N = 0 and C N = 0 for motions that no foundation resists: what is
    // there is rounding, and would strain ties.
    MatrixXd G_N = G * N, C_N = C * N;
    for (const Index j : loose)
      {
        G_N.col(j).tail(n_t).setZero();
        C_N.col(j).setZero();
      }

    MatrixXd       bound(n_e, n_e), coupling(n_e, n_k); // of what stays
    const MatrixXd W_t = all.block(n_c, 0, n_t, n_c + n_t)(rows, Eigen::all);
    const MatrixXd G_t = G_M(rows, Eigen::all);
    bound << W_t.rightCols(n_t)(Eigen::all, rows), G_t, -G_t.transpose(),
      M.transpose() * C * M;
    coupling << W_t.leftCols(n_c), G_N.bottomRows(n_t)(rows, Eigen::all),
      -(G.topRows(n_c) * M).transpose(), M.transpose() * C_N;
    // E^-1 = D (D E D)^-1 D; E is not symmetric, and not definite.
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
    // Both triangles are alike but for these signs and for rounding, which is
    // taken out.
    const MatrixXd other = sign.head(n_k).asDiagonal() * kept.transpose() *
                           sign.head(n_k).asDiagonal();
    kept = .5 * (kept + other);
  }

  /* The load in the rows of y: of all reactions of what is bound, as none is
     chosen yet, and of the motions that ties resist. */
  Eigen::VectorXd
  BoundUnknowns::bound_part(const VectorXd &load) const
  {
    AssertDimension(load.size(), n_contact + n_bound + M.rows());
    VectorXd result(n_bound + M.cols());
    result << load.segment(n_contact, n_bound),
      transposed_times(M, load.tail(M.rows()));
    return result;
  }

  Eigen::VectorXd
  BoundUnknowns::kept_part(const VectorXd &load) const
  {
    AssertDimension(load.size(), n_contact + n_bound + M.rows());
    VectorXd result(n_contact + N.cols());
    result << load.head(n_contact), transposed_times(N, load.tail(N.rows()));
    return result;
  }

  Eigen::VectorXd
  BoundUnknowns::chosen_part(const VectorXd &bound_load) const
  {
    AssertDimension(bound_load.size(), n_bound + M.cols());
    VectorXd result(scaling.size());
    result << bound_load(rows), bound_load.tail(M.cols());
    return result;
  }

  /* -S B^T S E^-1 load, by E^-1 B, which is known: E^-T = S E^-1 S. */
  Eigen::VectorXd
  BoundUnknowns::effect(const VectorXd &bound_load) const
  {
    const Index n_k = answer.cols();
    return -(sign.head(n_k).asDiagonal() *
             transposed_times(answer,
                              sign.tail(answer.rows()).asDiagonal() *
                                chosen_part(bound_load)));
  }

  /* y = -E^-1 (B x + load). Rows that others imply have no reaction in y; of
     all reactions that do the same the least are given in the end. */
  Eigen::VectorXd
  BoundUnknowns::bound_of(const VectorXd &unknowns,
                          const VectorXd &bound_load) const
  {
    AssertDimension(unknowns.size(), n_contact + N.cols());
    VectorXd x = -times(answer, unknowns);
    if (x.size() > 0)
      x -= scaling.asDiagonal() *
           factor.solve(scaling.asDiagonal() * chosen_part(bound_load));
    VectorXd   result     = VectorXd::Zero(n_bound + M.rows());
    const auto n_rows     = static_cast<Index>(rows.size());
    VectorXd   reactions  = VectorXd::Zero(n_bound);
    reactions(rows)       = x.head(n_rows);
    result.head(n_bound)  = redundant.least(reactions);
    result.tail(M.rows()) = times(M, x.tail(M.cols()));
    return result;
  }

  /* (r_c, r_t, a) from what solvers know, (r_c, a_f): all motions are those
     that are free and those that ties resist, a = N a_f + M a_t. */
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
