// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/lcp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
    using Eigen::VectorXi;

    /** Entries of a scaled column below this are round-off. */
    constexpr double pivot_tolerance = 1e-10;

    /**
     * The dictionary x_B = A x_N + b, n x (n + 1) numbers, of which a pivot
     * changes all: 2 n^2 operations. Variables: 0 .. n-1 are x, n .. 2n-1 are
     * z, 2n is the artificial one, which stands in the last column first.
     */
    struct Dictionary
    {
      MatrixXd           A;
      VectorXd           b;
      std::vector<Index> basic, nonbasic;

      Dictionary(const MatrixXd &M, const VectorXd &q, const VectorXd &cover)
        : A(M.rows(), M.cols() + 1)
        , b(q)
      {
        // x = M z + q + cover z_0: a large z_0 makes all x positive.
        A << M, cover;
        for (Index i = 0; i < q.size(); ++i)
          {
            basic.push_back(i);
            nonbasic.push_back(q.size() + i);
          }
        nonbasic.push_back(2 * q.size());
      }

      /** Exchanges the variables of a row and a column. */
      void
      pivot(const Index row, const Index column)
      {
        const double             p     = A(row, column);
        const double             value = -b(row) / p;
        const Eigen::RowVectorXd old   = A.row(row);
        const VectorXd           c     = A.col(column) / p;
        b -= b(row) * c;
        A.noalias() -= c * old;
        A.col(column)  = c;
        A.row(row)     = -old / p;
        A(row, column) = 1 / p;
        b(row)         = value;
        std::swap(basic[static_cast<std::size_t>(row)],
                  nonbasic[static_cast<std::size_t>(column)]);
      }

      Index
      column_of(const Index variable) const
      {
        return std::find(nonbasic.begin(), nonbasic.end(), variable) -
               nonbasic.begin();
      }
    };



    /** The row whose variable vanishes first as that of the column grows. */
    Index
    leaving_row(const Dictionary &d, const Index column, const VectorXi &rank)
    {
      const Index  n     = d.b.size();
      const double size  = std::max(1., d.A.col(column).cwiseAbs().maxCoeff());
      double       step  = std::numeric_limits<double>::infinity();
      const auto   falls = [&](const Index i) {
        return d.A(i, column) < -pivot_tolerance * size;
      };
      for (Index i = 0; i < n; ++i)
        if (falls(i))
          step = std::min(step, std::max(0., d.b(i)) / -d.A(i, column));
      const double tie =
        step + 1e-12 * std::max(step, d.b.cwiseAbs().maxCoeff() / size);

      // Where several vanish at once the smallest key decides: the artificial
      // variable, which ends the path; the least rank; the largest pivot.
      using Key  = std::tuple<int, int, double>;
      Index best = -1;
      Key   best_key;
      for (Index i = 0; i < n; ++i)
        {
          if (!falls(i) || std::max(0., d.b(i)) / -d.A(i, column) > tie)
            continue;
          const Index variable   = d.basic[static_cast<std::size_t>(i)];
          const bool  artificial = variable == 2 * n;
          const Key   key{artificial ? 0 : 1,
                        artificial || variable >= n ?
                            std::numeric_limits<int>::max() :
                            rank(variable),
                        d.A(i, column)};
          if (best < 0 || key < best_key)
            {
              best     = i;
              best_key = key;
            }
        }
      return best;
    }
  } // namespace



  bool
  solve_lcp(const MatrixXd &M,
            const VectorXd &q,
            const VectorXd &cover,
            const VectorXi &rank,
            VectorXd       &z)
  {
    eigen_assert(M.rows() == M.cols());
    eigen_assert(q.size() == M.rows());
    eigen_assert(cover.size() == M.rows());
    eigen_assert(rank.size() == M.rows());
    const Index    n     = q.size();
    const VectorXd scale = M.diagonal().unaryExpr(
      [](const double m) { return m > 0 ? 1 / std::sqrt(m) : 1.; });
    z = VectorXd::Zero(n);
    if (n == 0 || q.minCoeff() >= 0)
      return true;
    // Scaled to a diagonal of 1, tolerances mean the same in all units.
    Dictionary d(scale.asDiagonal() * M * scale.asDiagonal(),
                 scale.cwiseProduct(q),
                 scale.cwiseProduct(cover));

    // The artificial variable makes all x >= 0.
    Index row = 0;
    d.b.cwiseQuotient(d.A.col(n)).minCoeff(&row);
    Index column = n;
    for (Index k = 0; k < 20 * n + 100; ++k)
      {
        const Index left = d.basic[static_cast<std::size_t>(row)];
        d.pivot(row, column);
        if (left == 2 * n)
          {
            for (Index i = 0; i < n; ++i)
              {
                const Index variable = d.basic[static_cast<std::size_t>(i)];
                if (variable >= n && variable < 2 * n)
                  z(variable - n) = scale(variable - n) * std::max(0., d.b(i));
              }
            return z.allFinite();
          }
        // What left has a partner that enters now: so x_i z_i = 0 holds for all
        // pairs on the way.
        column = d.column_of(left < n ? left + n : left - n);
        row    = leaving_row(d, column, rank);
        // Nothing falls: the path goes off along a ray.
        if (row < 0)
          return false;
      }
    return false;
  }
} // namespace conetact::solvers
