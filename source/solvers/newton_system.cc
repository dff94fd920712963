// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/newton_system.h"

#include <lapacke.h>


#include <algorithm>
#include <array>
#include <cmath>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Does row k of the law say what unknown k is, and nothing else? */
    bool
    is_known(const NodeLaw &law, const Index k)
    {
      for (Index j = 0; j < law.p.cols(); ++j)
        if (law.d(k, j) != 0 || law.p(k, j) != (j == k ? 1. : 0.))
          return false;
      return true;
    }

    /** LU in place; false if a pivot says that the matrix is singular. */
    bool
    factorize(Eigen::MatrixXd &A, std::vector<lapack_int> &pivots)
    {
      const auto n = static_cast<lapack_int>(A.rows());
      pivots.resize(static_cast<std::size_t>(n));
      if (!A.allFinite())
        return false;
      if (LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, A.data(), n, pivots.data()) != 0)
        return false;
      const auto pivot = A.diagonal().cwiseAbs();
      return n == 0 || pivot.minCoeff() > 1e-13 * pivot.maxCoeff();
    }
  } // namespace



  void
  NewtonSystem::split(const LinearRelation       &relation,
                      const std::vector<NodeLaw> &laws)
  {
    unknown.clear();
    row.clear();
    const ContactSystem &system = relation.system();
    for (Index i = 0; i < system.n_nodes(); ++i)
      for (Index k = 0; k <= system.n_tangents(i); ++k)
        if (!is_known(laws[static_cast<std::size_t>(i)], k))
          {
            unknown.push_back(system.first[i] + k);
            row.push_back({i, k});
          }
  }



  void
  NewtonSystem::eliminate(const LinearRelation       &relation,
                          const std::vector<NodeLaw> &laws,
                          const Array                &rho,
                          Array                      &dp)
  {
    const ContactSystem &system = relation.system();
    dp                          = Array::Zero(system.n_unknowns());
    for (Index i = 0; i < system.n_nodes(); ++i)
      dp.segment(system.first[i], system.n_tangents(i) + 1) =
        laws[static_cast<std::size_t>(i)].h;
    for (const Index u : unknown)
      dp(u) = 0;

    Array d = rho;
    relation.multiply_add(dp, d);
    right_hand_side.resize(static_cast<Index>(unknown.size()));
    for (std::size_t a = 0; a < unknown.size(); ++a)
      {
        const NodeLaw &law   = laws[static_cast<std::size_t>(row[a].node)];
        const Index    first = system.first[row[a].node];
        const Index    dim = law.h.size(), k = row[a].local;
        right_hand_side(static_cast<Index>(a)) =
          law.h(k) - law.d.row(k).dot(d.segment(first, dim)) -
          law.p.row(k).dot(dp.segment(first, dim));
      }
  }



  template <typename Matrix>
  void
  NewtonSystem::assemble(const LinearRelation       &relation,
                         const std::vector<NodeLaw> &laws,
                         const double                shift,
                         Matrix                     &J) const
  {
    using Number                 = typename Matrix::Scalar;
    const ContactSystem   &system = relation.system();
    const Eigen::VectorXd &scale  = relation.column_scale();
    const Index            n      = static_cast<Index>(unknown.size());
    // Row a of the result is three consecutive rows of M with three weights.
    std::vector<Index>                 start(unknown.size());
    std::vector<std::array<double, 3>> weight(unknown.size());
    for (std::size_t a = 0; a < unknown.size(); ++a)
      {
        const NodeLaw &law = laws[static_cast<std::size_t>(row[a].node)];
        start[a]           = system.first[row[a].node];
        for (Index k = 0; k < 3; ++k)
          weight[a][static_cast<std::size_t>(k)] =
            k < law.d.cols() ? law.d(row[a].local, k) * scale(start[a] + k) : 0.;
      }

    J.resize(n, n);
    const Index last = system.n_unknowns() - 1;
    for (Index b = 0; b < n; ++b)
      {
        const Index   global = unknown[static_cast<std::size_t>(b)];
        const double *column = system.matrix.col(global).data();
        const double  s      = scale(global);
        for (std::size_t a = 0; a < unknown.size(); ++a)
          {
            // Weights are zero where a node is smaller; only stay inside.
            const Index i0 = start[a], i1 = std::min(i0 + 1, last),
                        i2 = std::min(i0 + 2, last);
            J(static_cast<Index>(a), b) = static_cast<Number>(
              s * (weight[a][0] * column[i0] + weight[a][1] * column[i1] +
                   weight[a][2] * column[i2]));
          }
      }
    for (Index a = 0; a < n; ++a)
      {
        const Row     &r   = row[static_cast<std::size_t>(a)];
        const NodeLaw &law = laws[static_cast<std::size_t>(r.node)];
        for (Index b = 0; b < n; ++b)
          {
            const Row &c = row[static_cast<std::size_t>(b)];
            if (c.node == r.node)
              J(a, b) += static_cast<Number>(law.p(r.local, c.local) +
                                             shift * law.d(r.local, c.local));
          }
      }
  }



  bool
  NewtonSystem::solve_directly(const LinearRelation       &relation,
                               const std::vector<NodeLaw> &laws,
                               const double                shift,
                               Array                      &x)
  {
    std::vector<lapack_int> pivots;
    assemble(relation, laws, shift, matrix);
    ++factorizations;
    if (!factorize(matrix, pivots))
      return false;
    x            = right_hand_side;
    const auto n = static_cast<lapack_int>(x.size());
    LAPACKE_dgetrs(
      LAPACK_COL_MAJOR, 'N', n, 1, matrix.data(), n, pivots.data(), x.data(), n);
    return x.allFinite();
  }



  bool
  NewtonSystem::solve(const LinearRelation       &relation,
                      const std::vector<NodeLaw> &laws,
                      const Array                &rho,
                      const double                precision,
                      Array                      &dp)
  {
    (void)precision;
    split(relation, laws);
    eliminate(relation, laws, rho, dp);
    if (unknown.empty())
      return dp.allFinite();

    // A singular matrix (a body that is free to move, a reaction that is not
    // unique) gets a small multiple of the identity on M. Newton then leaves
    // the undetermined part where it is, and makes up for the rest.
    Array x;
    bool  solved = solve_directly(relation, laws, 0, x);
    for (const double shift : {1e-9, 1e-6})
      if (!solved)
        solved = solve_directly(relation, laws, shift, x);
    if (!solved)
      return false;
    for (std::size_t a = 0; a < unknown.size(); ++a)
      dp(unknown[a]) = x(static_cast<Index>(a));
    return true;
  }
} // namespace conetact
