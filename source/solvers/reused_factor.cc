// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/reused_factor.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;

    /** Vectors of the Krylov space: beyond, a new factor is cheaper. */
    constexpr Index max_directions = 40;

    /** Rotates (a, b) to (r, 0), as Givens does it. */
    struct Rotation
    {
      float c = 1, s = 0;
      Rotation(const float a, const float b)
      {
        const float r = std::hypot(a, b);
        if (r > 0)
          {
            c = a / r;
            s = b / r;
          }
      }
      void
      apply(float &a, float &b) const
      {
        const float t = c * a + s * b;
        b             = -s * a + c * b;
        a             = t;
      }
    };
  } // namespace



  /* A pivot below 1e-6 of the largest is rounding: single precision has 6e-8,
     which grows in the elimination. */
  bool
  ReusedFactor::factorize(const Matrix &A, const std::vector<Index> &numbers)
  {
    eigen_assert(A.rows() == A.cols());
    eigen_assert(static_cast<Index>(numbers.size()) == A.rows());
    const auto n   = static_cast<lapack_int>(A.rows());
    factor         = A;
    factor_numbers = numbers;
    pivots.resize(numbers.size());
    ++factorizations;
    const lapack_int info = LAPACKE_sgetrf_work(
      LAPACK_COL_MAJOR, n, n, factor.data(), n, pivots.data());
    const auto pivot = factor.diagonal().cwiseAbs();
    const bool good  = info == 0 && pivot.minCoeff() > 1e-6f * pivot.maxCoeff();
    // A singular factor would spoil the next solve as well.
    if (!good)
      factor_numbers.clear();
    return good;
  }



  /* Both lists of numbers ascend: one pass over them finds all pairs. */
  void
  ReusedFactor::match(const Matrix &A, const std::vector<Index> &numbers)
  {
    eigen_assert(std::is_sorted(numbers.begin(), numbers.end()));
    position.assign(numbers.size(), -1);
    inverse_diagonal.resize(A.rows());
    n_new         = 0;
    std::size_t k = 0;
    for (std::size_t a = 0; a < numbers.size(); ++a)
      {
        while (k < factor_numbers.size() && factor_numbers[k] < numbers[a])
          ++k;
        if (k < factor_numbers.size() && factor_numbers[k] == numbers[a])
          position[a] = static_cast<Index>(k);
        else
          ++n_new;
        const Index i = static_cast<Index>(a);
        const float d = A(i, i);
        // A diagonal near zero, as in rows of balance, says nothing.
        inverse_diagonal(i) = std::abs(d) > 1e-3f ? 1 / d : 1.f;
      }
  }



  /* Where a quarter of the unknowns is new, or most of the factor belongs to
     unknowns that are gone, it costs more than it saves. */
  bool
  ReusedFactor::worth_trying(const Index n) const
  {
    const auto old = static_cast<Index>(factor_numbers.size());
    return old > 0 && n_new <= n / 4 && old <= 2 * n;
  }



  /* The earlier matrix may have had unknowns that are gone, and lacked some of
     the present ones: its factor solves for all of its own, of which those that
     are left are taken. */
  ReusedFactor::Vector
  ReusedFactor::precondition(const Vector &b) const
  {
    eigen_assert(b.size() == inverse_diagonal.size());
    const auto n = static_cast<lapack_int>(factor.rows());
    if (factor_numbers.empty())
      return inverse_diagonal.cwiseProduct(b);
    // Unknowns that the new matrix has not keep a right-hand side of zero.
    Vector y = Vector::Zero(n);
    for (std::size_t a = 0; a < position.size(); ++a)
      if (position[a] >= 0)
        y(position[a]) = b(static_cast<Index>(a));
    LAPACKE_sgetrs_work(LAPACK_COL_MAJOR,
                        'N',
                        n,
                        1,
                        factor.data(),
                        n,
                        pivots.data(),
                        y.data(),
                        n);
    Vector result(b.size());
    for (std::size_t a = 0; a < position.size(); ++a)
      {
        const Index i = static_cast<Index>(a);
        result(i) =
          position[a] >= 0 ? y(position[a]) : inverse_diagonal(i) * b(i);
      }
    return result;
  }



  bool
  ReusedFactor::gmres(const Matrix &A,
                      const Vector &b,
                      const float   precision,
                      Vector       &x) const
  {
    eigen_assert(b.size() == A.rows());
    eigen_assert(precision > 0);
    const float norm = b.norm();
    x                = Vector::Zero(b.size());
    if (norm == 0)
      return true;
    // Preconditioned from the right: g is the residual of A x = b itself. Z =
    // M^-1 V is kept, so that x costs no further solve.
    Matrix                V(b.size(), max_directions + 1);
    Matrix                Z(b.size(), max_directions);
    Matrix                H = Matrix::Zero(max_directions + 1, max_directions);
    Vector                g = Vector::Zero(max_directions + 1);
    std::vector<Rotation> rotations;
    V.col(0) = b / norm;
    g(0)     = norm;
    Index k  = 0;
    while (k < max_directions && std::abs(g(k)) > precision * norm)
      {
        Z.col(k)         = precondition(V.col(k));
        Vector     w     = A * Z.col(k);
        const auto basis = V.leftCols(k + 1);
        // Orthogonalised twice: once is not enough in single precision.
        const Vector once = basis.transpose() * w;
        w -= basis * once;
        const Vector again = basis.transpose() * w;
        w -= basis * again;
        H.col(k).head(k + 1) = once + again;
        H(k + 1, k)          = w.norm();
        // Where w vanishes the result is exact, and the loop ends.
        V.col(k + 1) = w / H(k + 1, k);
        for (Index i = 0; i < k; ++i)
          rotations[static_cast<std::size_t>(i)].apply(H(i, k), H(i + 1, k));
        rotations.emplace_back(H(k, k), H(k + 1, k));
        rotations.back().apply(H(k, k), H(k + 1, k));
        rotations.back().apply(g(k), g(k + 1));
        ++k;
      }
    const bool done = std::abs(g(k)) <= precision * norm;
    x               = Z.leftCols(k) *
        H.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g.head(k));
    return done && x.allFinite();
  }



  bool
  ReusedFactor::solve(const Matrix             &A,
                      const std::vector<Index> &numbers,
                      const Vector             &b,
                      const float               precision,
                      Vector                   &x)
  {
    eigen_assert(b.size() == A.rows());
    eigen_assert(static_cast<Index>(numbers.size()) == A.rows());
    // Single precision gives 3e-6 at best; with a new factor 3e-5 is enough, as
    // nothing better could follow.
    match(A, numbers);
    if (!worth_trying(A.rows()))
      // The diagonal is tried first, without a factor.
      factor_numbers.clear();
    if (gmres(A, b, std::max(precision, 3e-6f), x))
      return true;
    if (!factorize(A, numbers))
      return false;
    match(A, numbers);
    return gmres(A, b, std::max(precision, 3e-5f), x);
  }
} // namespace conetact::solvers
