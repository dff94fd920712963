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

    /** w -= c v, and (w, next) of what is left. Both at once, piece by piece:
     * w comes from the memory once, and sums in single precision are short. */
    double
    subtract_and_project(const double       c,
                         const FloatVector &v,
                         const FloatVector &next,
                         FloatVector       &w)
    {
      double sum = 0;
      for_pieces(w, [&](const Index i, const Index n) {
        w.segment(i, n) -= static_cast<float>(c) * v.segment(i, n);
        sum += static_cast<double>(w.segment(i, n).dot(next.segment(i, n)));
      });
      return sum;
    }
  } // namespace



  FlexibleGmres::FlexibleGmres(const Communicator &all)
    : processes(all)
  {}



  /* A process that is alone goes the modified way of Gram and Schmidt, one
     vector after the other. Each of its products would be a message: several
     processes go the classical way, all products at once, and go it twice, as
     once is not exact enough. The norm needs no third message: with orthonormal
     V, |w - V p|^2 = |w|^2 - |p|^2, where p of the second pass is so small that
     no digits are lost. */
  double
  FlexibleGmres::orthogonalize(Eigen::Ref<VectorXd> along)
  {
    if (processes.size() == 1)
      {
        along(0) = subtract_and_project(0, V.front(), V.front(), w);
        for (Index i = 1; i < along.size(); ++i)
          along(i) =
            subtract_and_project(along(i - 1), V[at(i - 1)], V[at(i)], w);
        const Index last = along.size() - 1;
        return std::sqrt(subtract_and_project(along(last), V[at(last)], w, w));
      }
    const Index n_along = along.size();
    VectorXd    parts(n_along + 1);
    along.setZero();
    for (int pass = 0; pass < 2; ++pass)
      {
        parts.setZero();
        for_pieces(w, [&](const Index begin, const Index size) {
          const auto part = w.segment(begin, size);
          for (Index i = 0; i < n_along; ++i)
            parts(i) +=
              static_cast<double>(part.dot(V[at(i)].segment(begin, size)));
          parts(n_along) += static_cast<double>(part.squaredNorm());
        });
        processes.sum(parts.data(), parts.size());
        along += parts.head(n_along);
        for_pieces(w, [&](const Index begin, const Index size) {
          for (Index i = 0; i < n_along; ++i)
            w.segment(begin, size) -=
              static_cast<float>(parts(i)) * V[at(i)].segment(begin, size);
        });
      }
    return std::sqrt(
      std::max(parts(n_along) - parts.head(n_along).squaredNorm(), 0.));
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
