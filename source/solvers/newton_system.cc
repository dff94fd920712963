// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/newton_system.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Below this size a factorisation, 2 n^3 / 3 operations at the pace of
     * LAPACK, costs less than its reuse, 4 n^2 at that of memory for each
     * iteration. */
    constexpr Index reuse_from = 150;

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
      if (LAPACKE_dgetrf_work(
            LAPACK_COL_MAJOR, n, n, A.data(), n, pivots.data()) != 0)
        return false;
      // Without units pivots compare with each other: rounding leaves 1e-16 or
      // so of a singular one.
      const auto pivot = A.diagonal().cwiseAbs();
      return n == 0 || pivot.minCoeff() > 1e-13 * pivot.maxCoeff();
    }
  } // namespace



  bool
  NewtonSystem::was_small() const
  {
    return static_cast<Index>(unknown.size()) < reuse_from;
  }



  void
  NewtonSystem::split(const LinearRelation       &relation,
                      const std::vector<NodeLaw> &laws)
  {
    unknown.clear();
    row.clear();
    const ContactSystem &system = relation.system();
    for (Index i = 0; i < static_cast<Index>(laws.size()); ++i)
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
    for (Index i = 0; i < static_cast<Index>(laws.size()); ++i)
      dp.segment(system.first[i], system.n_tangents(i) + 1) =
        laws[static_cast<std::size_t>(i)].h;
    for (const Index u : unknown)
      dp(u) = 0;

    // (P + D M) dp = h - D rho, with what is known of dp moved to the right.
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



  /** J += P + shift D, block by block. */
  template <typename Matrix>
  void
  NewtonSystem::add_node_blocks(const std::vector<NodeLaw> &laws,
                                const double                shift,
                                Matrix                     &J) const
  {
    eigen_assert(J.rows() == J.cols());
    eigen_assert(shift >= 0);
    using Number = typename Matrix::Scalar;
    for (std::size_t a = 0; a < row.size(); ++a)
      {
        const Row     &r   = row[a];
        const NodeLaw &law = laws[static_cast<std::size_t>(r.node)];
        const auto     add = [&](const std::size_t b) {
          const Index k = row[b].local;
          J(static_cast<Index>(a), static_cast<Index>(b)) +=
            static_cast<Number>(law.p(r.local, k) + shift * law.d(r.local, k));
        };
        // Rows of a node are neighbours.
        for (std::size_t b = a; b < row.size() && row[b].node == r.node; ++b)
          add(b);
        for (std::size_t b = a; b > 0 && row[b - 1].node == r.node; --b)
          add(b - 1);
      }
  }



  /**
   * J = P + D (M + shift) for the rows and columns that are left. D mixes rows
   * of one node only, so M is read column by column and never multiplied as a
   * whole.
   */
  template <typename Matrix>
  void
  NewtonSystem::assemble(const LinearRelation       &relation,
                         const std::vector<NodeLaw> &laws,
                         const double                shift,
                         Matrix                     &J) const
  {
    using Number                = typename Matrix::Scalar;
    const ContactSystem &system = relation.system();
    const Array         &scale  = relation.column_scale();
    const auto           n      = static_cast<Index>(unknown.size());

    // The rows of a node are combinations of its rows of M: all of them at
    // once, by columns of weights.
    struct NodeRows
    {
      using Weights = Eigen::Array<Number, 4, 3>;
      Index   first, start, dim;
      Weights weights;
    };
    std::vector<NodeRows> nodes;
    for (Index a = 0; a < n; ++a)
      {
        const Row     &r     = row[static_cast<std::size_t>(a)];
        const NodeLaw &law   = laws[static_cast<std::size_t>(r.node)];
        const Index    start = system.first[r.node];
        if (nodes.empty() || nodes.back().start != start)
          nodes.push_back({a, start, law.d.cols(), NodeRows::Weights::Zero()});
        NodeRows &node = nodes.back();
        for (Index k = 0; k < node.dim; ++k)
          node.weights(a - node.first, k) =
            static_cast<Number>(law.d(r.local, k) * scale(start + k));
      }

    // Four rows are written for each node: those too many are overwritten. A
    // column is rounded as a whole, many numbers at once.
    J.resize(n, n);
    Eigen::Array<Number, Eigen::Dynamic, 1> column(n + 4);
    std::vector<Number> M(static_cast<std::size_t>(system.matrix.rows()));
    for (Index b = 0; b < n; ++b)
      {
        const Index         u    = unknown[static_cast<std::size_t>(b)];
        const double *const from = system.matrix.col(u).data();
        std::transform(from, from + M.size(), M.begin(), [](const double x) {
          return static_cast<Number>(x);
        });
        for (const NodeRows &node : nodes)
          {
            const Number *const        m   = M.data() + node.start;
            Eigen::Array<Number, 4, 1> sum = node.weights.col(0) * m[0];
            for (Index k = 1; k < node.dim; ++k)
              sum += node.weights.col(k) * m[k];
            column.template segment<4>(node.first) = sum;
          }
        J.col(b) = (static_cast<Number>(scale(u)) * column.head(n)).matrix();
      }
    add_node_blocks(laws, shift, J);
  }



  bool
  NewtonSystem::solve_directly(const LinearRelation       &relation,
                               const std::vector<NodeLaw> &laws,
                               const double                shift,
                               Array                      &x)
  {
    assemble(relation, laws, shift, matrix);
    ++factorizations;
    if (!factorize(matrix, pivots))
      return false;
    is_factorized = true;
    x             = right_hand_side;
    substitute(x);
    return x.allFinite();
  }



  void
  NewtonSystem::substitute(Array &x) const
  {
    eigen_assert(is_factorized && x.size() == matrix.rows());
    const auto n = static_cast<lapack_int>(x.size());
    LAPACKE_dgetrs(LAPACK_COL_MAJOR,
                   'N',
                   n,
                   1,
                   matrix.data(),
                   n,
                   pivots.data(),
                   x.data(),
                   n);
  }



  void
  NewtonSystem::scatter(const Array &x, Array &dp) const
  {
    for (std::size_t a = 0; a < unknown.size(); ++a)
      dp(unknown[a]) = x(static_cast<Index>(a));
  }



  /* A solution in single precision is good enough: the next step of Newton's
     method begins with the residual in double precision. */
  bool
  NewtonSystem::solve_with_reuse(const LinearRelation       &relation,
                                 const std::vector<NodeLaw> &laws,
                                 const double                precision,
                                 Array                      &x)
  {
    // What is to be exact, or costs next to nothing, is left to LAPACK.
    if (was_small() || precision == 0)
      return false;
    const double norm = right_hand_side.norm();
    if (!(norm > 0) || !std::isfinite(norm))
      return false;
    Eigen::VectorXf solution;
    // Newton's method converges quadratically: what a step leaves of the
    // right-hand side is also the part of the matrix that it changes.
    fresh =
      !(fresh && unknown == assembled && norm < .1 * precision * last_norm);
    last_norm = norm;
    if (fresh)
      {
        assemble(relation, laws, 0, single);
        assembled = unknown;
      }
    const unsigned int before = reused.n_factorizations();
    const bool         done   = reused.solve(single,
                                   unknown,
                                   (right_hand_side / norm).cast<float>(),
                                   static_cast<float>(precision),
                                   solution);
    factorizations += reused.n_factorizations() - before;
    if (done)
      x = norm * solution.cast<double>();
    return done;
  }



  bool
  NewtonSystem::solve(const LinearRelation       &relation,
                      const std::vector<NodeLaw> &laws,
                      const Array                &rho,
                      const double                precision,
                      Array                      &dp,
                      const bool                  regularised)
  {
    eigen_assert(static_cast<Index>(laws.size()) ==
                 relation.system().n_nodes() + relation.system().n_motions);
    eigen_assert(rho.size() == relation.system().n_unknowns());
    eigen_assert(precision >= 0);
    is_factorized = false;
    split(relation, laws);
    eliminate(relation, laws, rho, dp);
    if (unknown.empty())
      return dp.allFinite();

    // A singular matrix (a body that is free to move, a reaction that is not
    // unique) gets a small multiple of the identity on M. Newton then leaves
    // the undetermined part where it is, and makes up for the rest.
    Array x;
    bool  solved = solve_with_reuse(relation, laws, precision, x) ||
                  solve_directly(relation, laws, 0, x);
    for (const double shift : {1e-9, 1e-6})
      if (!solved && regularised)
        solved = solve_directly(relation, laws, shift, x);
    if (!solved)
      return false;
    scatter(x, dp);
    return true;
  }



  bool
  NewtonSystem::solve_again(const LinearRelation       &relation,
                            const std::vector<NodeLaw> &laws,
                            Array                      &dp)
  {
    if (!is_factorized)
      return false;
    const std::vector<Index> before = unknown;
    split(relation, laws);
    is_factorized = unknown == before;
    if (!is_factorized)
      return false;
    eliminate(relation, laws, Array::Zero(relation.system().n_unknowns()), dp);
    Array x = right_hand_side;
    substitute(x);
    scatter(x, dp);
    return dp.allFinite();
  }
} // namespace conetact::solvers
