// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/flexible_gmres.h"

#include "conetact/base/index.h"
#include "conetact/iterative/multigrid.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace conetact::iterative
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;
  } // namespace



  FlexibleGmres::FlexibleGmres(const Communicator &all)
    : processes(all)
  {}



  /* The modified way of Gram and Schmidt, h_i = v_i^T (w - sum_{j<i} h_j v_j)
     over |v_i|^2, is L h = V^T w, where L is the lower triangle of V^T V: one
     sum over all processes brings V^T w, |w|^2 and the last row of L
     (Swirydowicz et al., Numer. Linear Algebra Appl. 28 (2021) e2343). So does
     the norm of what is left, |w|^2 - 2 h^T V^T w + h^T V^T V h: where digits
     cancel it is off, and so is the length of the next vector, which L knows.
   */
  double
  FlexibleGmres::orthogonalize(Eigen::Ref<VectorXd> along)
  {
    const Index n = along.size();
    // Piece by piece: w stays in the cache, V comes from the memory twice.
    VectorXd parts = VectorXd::Zero(2 * n + 1);
    for_pieces(w, [&](const Index begin, const Index size) {
      const auto part = w.segment(begin, size),
                 last = V[at(n - 1)].segment(begin, size);
      for (Index i = 0; i < n; ++i)
        {
          const auto v = V[at(i)].segment(begin, size);
          parts(i) += static_cast<double>(v.dot(part));
          parts(n + i) += static_cast<double>(v.dot(last));
        }
      parts(2 * n) += static_cast<double>(part.squaredNorm());
    });
    processes.sum(parts.data(), parts.size());
    products.row(n - 1).head(n) = parts.segment(n, n).transpose();
    const auto L                = products.topLeftCorner(n, n);
    along = L.triangularView<Eigen::Lower>().solve(parts.head(n));
    for_pieces(w, [&](const Index begin, const Index size) {
      for (Index i = 0; i < n; ++i)
        w.segment(begin, size) -=
          static_cast<float>(along(i)) * V[at(i)].segment(begin, size);
    });
    const VectorXd projected = L.selfadjointView<Eigen::Lower>() * along;
    return std::sqrt(
      std::max(parts(2 * n) + along.dot(projected - 2 * parts.head(n)), 0.));
  }



  /* Flexible GMRES from x = 0 (Saad, SIAM J. Sci. Comput. 14 (1993) 461-469):
     A Z = V H with z_k = M v_k, H of Hessenberg's form, v_0 = b, |b| = 1; then
     x = Z y, y = argmin |e_0 - H y|. Rotations keep H triangular, and |g(k)| is
     what is left of b after k steps, without a product more. Z is kept as the
     preconditioner may vary: 2 x 40 + 2 float vectors, 328 bytes an unknown.
     H and g are small and in double precision. */
  FloatVector
  FlexibleGmres::solve(const FloatVector &b,
                       const double       goal,
                       const Product     &multiply,
                       const Product     &precondition,
                       unsigned int      &iterations)
  {
    Assert(goal > 0, dealii::ExcMessage("Single precision has an end."));
    Assert(b.allFinite(), dealii::ExcMessage("Right-hand sides are finite."));
    const auto next = [](auto &list, const Index i) -> auto &
    {
      if (list.size() <= at(i))
        list.emplace_back();
      return list[at(i)];
    };
    next(V, 0) = b;
    products.resize(cycle_length, cycle_length);
    // Vectors of the cycle before are kept and written again: from the second
    // cycle on nothing is allocated.
    w.resize(b.size());
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(cycle_length + 1, cycle_length);
    VectorXd        g = VectorXd::Zero(cycle_length + 1);
    g(0)              = 1;
    std::vector<Eigen::JacobiRotation<double>> turns(cycle_length);
    Index                                      k = 0;
    for (; k < cycle_length && std::abs(g(k)) > goal; ++k, ++iterations)
      {
        FloatVector &z = next(Z, k);
        precondition(V[at(k)], z);
        multiply(z, w);
        H(k + 1, k) = orthogonalize(H.col(k).head(k + 1));
        if (!std::isfinite(H(k + 1, k))) // x is made of the steps before
          break;
        // Zero is left of w where x is exact: g tells it in this very step.
        next(V, k + 1) = w / static_cast<float>(std::max(H(k + 1, k), 1e-30));
        for (Index i = 0; i < k; ++i)
          H.col(k).applyOnTheLeft(i, i + 1, turns[at(i)].adjoint());
        turns[at(k)].makeGivens(H(k, k), H(k + 1, k));
        H.col(k).applyOnTheLeft(k, k + 1, turns[at(k)].adjoint());
        g.applyOnTheLeft(k, k + 1, turns[at(k)].adjoint());
      }
    // Rotations have kept H triangular: the least squares problem that is left
    // is a back substitution of size k.
    const VectorXd y =
      H.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g.head(k));
    FloatVector x = FloatVector::Zero(b.size());
    for (Index i = 0; i < k; ++i)
      x += static_cast<float>(y(i)) * Z[at(i)];
    return x;
  }
} // namespace conetact::iterative
