// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/extended_schur.h"

#include <algorithm>

namespace conetact::backends
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;

    // Unit forces that are treated together: their displacements are as long
    // as A is large.
    constexpr Index columns_at_once = 64;

    Index
    size(const std::vector<Index> &list)
    {
      return static_cast<Index>(list.size());
    }
  } // namespace



  ExtendedSchur::ExtendedSchur(const Eigen::SparseMatrix<double> &upper,
                               const Index                        n_schur,
                               const std::vector<unsigned int>   &node_of,
                               const Condenser                   &condenser)
    : n_unknowns(upper.cols())
    , solver(condenser.create(upper, n_schur, node_of))
  {}



  void
  ExtendedSchur::extend(const std::vector<Index> &unknowns, MatrixXd &S)
  {
    const Index n_before = size(added), n_new = size(unknowns);
    const Index n_base = S.cols() - n_before;
    added.insert(added.end(), unknowns.begin(), unknowns.end());

    MatrixXd D(size(added), n_new), X(n_new, n_base);
    for (Index first = 0; first < n_new; first += columns_at_once)
      {
        const Index count = std::min(columns_at_once, n_new - first);
        MatrixXd    unit  = MatrixXd::Zero(n_unknowns, count);
        for (Index k = 0; k < count; ++k)
          unit(unknowns[static_cast<std::size_t>(first + k)], k) = 1;
        // -A_CF A_FF^-1 e_k is row k of X, and A_FF^-1 e_k at the added
        // unknowns column k of D.
        X.middleRows(first, count) = solver->reduce(unit).transpose();
        D.middleCols(first, count) =
          solver->expand(unit, MatrixXd::Zero(n_base, count))(added,
                                                              Eigen::all);
      }
    append(D, X);

    const Index n     = size(added);
    const auto  B_new = B.bottomRows(n_new);
    // X^T D^-1 X = B^T B, of which only the new rows are missing in S.
    const MatrixXd S_base =
      S.topLeftCorner(n_base, n_base) + B_new.transpose() * B_new;
    const auto lower = L.triangularView<Eigen::Lower>();
    S.resize(n_base + n, n_base + n);
    S.topLeftCorner(n_base, n_base) = S_base;
    S.bottomLeftCorner(n, n_base) =
      -L.transpose().triangularView<Eigen::Upper>().solve(B);
    S.topRightCorner(n_base, n) = S.bottomLeftCorner(n, n_base).transpose();
    const MatrixXd inverse      = lower.solve(MatrixXd::Identity(n, n));
    S.bottomRightCorner(n, n)   = inverse.transpose() * inverse;
  }



  void
  ExtendedSchur::append(const MatrixXd &D, const MatrixXd &X)
  {
    const Index n_old = L.rows(), n_new = D.cols(), n = n_old + n_new;
    L.conservativeResizeLike(MatrixXd::Zero(n, n));
    B.conservativeResize(n, X.cols());
    // The Cholesky factor of D grows by rows: those before stay.
    const auto old = L.topLeftCorner(n_old, n_old);
    const auto row = L.bottomLeftCorner(n_new, n_old);
    L.bottomLeftCorner(n_new, n_old) =
      old.triangularView<Eigen::Lower>().solve(D.topRows(n_old)).transpose();
    const MatrixXd rest = D.bottomRows(n_new) - row * row.transpose();
    const Eigen::LLT<MatrixXd> factor(rest);
    if (factor.info() != Eigen::Success)
      throw SingularMatrix(std::nullopt);
    L.bottomRightCorner(n_new, n_new) = factor.matrixL();
    B.bottomRows(n_new) = factor.matrixL().solve(X - row * B.topRows(n_old));
  }



  MatrixXd
  ExtendedSchur::reduce(const MatrixXd &b) const
  {
    const MatrixXd r = solver->reduce(b);
    if (added.empty())
      return r;
    const auto lower = L.triangularView<Eigen::Lower>();
    // L^-1 z_N: what the load moves the added unknowns by, while they are still
    // eliminated.
    const MatrixXd z = lower.solve(MatrixXd(solver->expand(
      b, MatrixXd::Zero(r.rows(), b.cols()))(added, Eigen::all)));
    MatrixXd       result(r.rows() + size(added), b.cols());
    result.topRows(r.rows()) = r - B.transpose() * z;
    result.bottomRows(size(added)) =
      L.transpose().triangularView<Eigen::Upper>().solve(z);
    return result;
  }



  MatrixXd
  ExtendedSchur::expand(const MatrixXd &b,
                        const MatrixXd &u,
                        const MatrixXd &reduced) const
  {
    if (added.empty())
      return solver->expand(b, u);
    const Index n      = size(added);
    const auto  lower  = L.triangularView<Eigen::Lower>();
    const auto  u_base = u.topRows(u.rows() - n);
    // the forces that keep the unknowns added at u
    const MatrixXd f = L.transpose().triangularView<Eigen::Upper>().solve(
                         lower.solve(u.bottomRows(n)) - B * u_base) -
                       reduced.bottomRows(n);
    MatrixXd forces = b;
    for (Index k = 0; k < n; ++k)
      forces.row(added[static_cast<std::size_t>(k)]) += f.row(k);
    return solver->expand(forces, u_base);
  }
} // namespace conetact::backends
