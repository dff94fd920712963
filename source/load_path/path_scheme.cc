// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/path_scheme.h"

#include "conetact/solvers/null_space.h"

#include <lapacke.h>

#include <cmath>
#include <stdexcept>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /**
     * Reciprocal condition number (without units) below which a scheme counts
     * as a mechanism. Those of real schemes stay above 1e-9, those of
     * mechanisms are round-off: the null space of K is exact, see PathSystem.
     */
    constexpr double singular = 1e-13;

    /**
     * Share of the loads that the springs of PathSystem::held may carry where
     * a scheme is a mechanism: round-off of loads that do no work on it.
     */
    constexpr double undriven = 1e-9;

    /** Refinements of a solution by its residual. */
    constexpr int n_refinements = 2;

    VectorXd
    node_scales(const solvers::ContactSystem &system)
    {
      const double all =
        system.matrix.trace() /
        static_cast<double>(std::max<Index>(1, system.n_unknowns()));
      VectorXd scale(system.n_unknowns());
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const Index  first = system.first[i], dim = system.n_tangents(i) + 1;
          const double mean =
            system.matrix.diagonal().segment(first, dim).mean();
          const double c = mean > 1e-12 * all ? mean : all > 0 ? all : 1.;
          scale.segment(first, dim).setConstant(1 / std::sqrt(c));
        }
      return scale;
    }
  } // namespace



  PathSystem::PathSystem(const solvers::ContactSystem &contact, const Vector &c)
    : scale(node_scales(contact))
    , mu(contact.mu)
    , cohesion(c.size() > 0 ? c : Vector::Zero(contact.n_nodes()).eval())
  {
    eigen_assert(mu.size() == contact.n_nodes());
    eigen_assert(cohesion.size() == contact.n_nodes());
    eigen_assert((cohesion.array() >= 0).all());
    if (contact.form != solvers::Form::stiffness)
      throw std::invalid_argument(
        "The load path needs the stiffness form of a contact problem.");
    for (Index i = 0; i < contact.n_nodes(); ++i)
      {
        if (contact.n_tangents(i) > 1)
          throw std::invalid_argument(
            "The load path follows events in two dimensions only.");
        normal.push_back(contact.normal(i));
        tangent.push_back(contact.n_tangents(i) == 1 ? contact.first[i] : -1);
        // a force, in scaled size
        cohesion(i) *= scale(contact.normal(i));
      }
    K          = scale.asDiagonal() * contact.matrix * scale.asDiagonal();
    null_space = contact.null_space.cols() > 0 ?
                   solvers::orthonormal_basis(
                     scale.cwiseInverse().asDiagonal() * contact.null_space) :
                   solvers::null_space_basis(K);
    // Mechanisms must be singular to the last digit.
    K -= null_space * (null_space.transpose() * K).eval();
    K -= ((K * null_space) * null_space.transpose()).eval();
    K = .5 * (K + K.transpose()).eval();
    if (null_space.cols() == K.cols()) // nothing strains
      K.setZero();
    held = K + shift * null_space * null_space.transpose();
  }



  SchemeFactor::SchemeFactor(const PathSystem &s,
                             const Scheme     &states,
                             const bool        held)
    : system(&s)
    , K(held ? &s.held : &s.K)
    , scheme(states)
  {
    eigen_assert(static_cast<Index>(scheme.size()) == s.n_nodes());
    collect_unknowns();
    factorize();
    if (held && is_regular)
      find_motions();
  }



  /* r_n = 0 at open nodes and r_t + s mu r_n = -s c at slipping ones: with r =
     K v - f each is a row of K, or that of the tangent plus s mu times that of
     the normal. Reactions never are unknowns. */
  void
  SchemeFactor::collect_unknowns()
  {
    for (Index i = 0; i < system->n_nodes(); ++i)
      {
        const auto       node = static_cast<std::size_t>(i);
        const NodeScheme s    = scheme[node];
        const Index      t    = system->tangent[node];
        const bool       free = system->is_free(i, s.closed);
        if (t >= 0 && (free || s.slip != 0))
          {
            unknown.push_back(t);
            normal.push_back(s.closed ? system->normal[node] : -1);
            weight.push_back(s.closed && !free ? s.slip * system->mu(i) : 0);
          }
        if (!s.closed)
          {
            unknown.push_back(system->normal[node]);
            normal.push_back(-1);
            weight.push_back(0);
          }
      }
  }



  void
  SchemeFactor::factorize()
  {
    const auto n = static_cast<lapack_int>(unknown.size());
    is_regular   = true;
    if (n == 0)
      return;
    factor.resize(n, n);
    for (Index b = 0; b < n; ++b)
      {
        const auto column = K->col(unknown[static_cast<std::size_t>(b)]);
        for (std::size_t a = 0; a < unknown.size(); ++a)
          factor(static_cast<Index>(a), b) =
            column(unknown[a]) +
            (weight[a] != 0 ? weight[a] * column(normal[a]) : 0.);
      }
    // LAPACK's estimate of the condition: with friction the matrix is not
    // symmetric, and pivots alone would miss a mechanism.
    const double norm = factor.cwiseAbs().colwise().sum().maxCoeff();
    pivots.resize(unknown.size());
    double condition = 0;
    is_regular =
      LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, factor.data(), n, pivots.data()) ==
        0 &&
      LAPACKE_dgecon(
        LAPACK_COL_MAJOR, '1', n, factor.data(), n, norm, &condition) == 0 &&
      condition > singular;
  }



  /**
   * With N the null space of K and k the springs on it, the motions are the
   * X = (J + k N N^T)^-1 k N a that stretch the springs as the loads k N a
   * alone do, N^T X = a: nothing but the springs resists them.
   */
  void
  SchemeFactor::find_motions()
  {
    const MatrixXd &N = system->null_space;
    if (N.cols() == 0)
      return;
    MatrixXd X;
    solve(PathSystem::shift * N, X);
    const MatrixXd rest =
      MatrixXd::Identity(N.cols(), N.cols()) - N.transpose() * X;
    const Eigen::JacobiSVD<MatrixXd> svd(rest, Eigen::ComputeFullV);
    const Index    n_motions = (svd.singularValues().array() < 1e-3).count();
    const MatrixXd a         = svd.matrixV().rightCols(n_motions);
    motions                  = X * a;
    coordinates              = a.transpose() * N.transpose();
  }



  bool
  SchemeFactor::is_driven(const Vector &load_rate, const Vector &v) const
  {
    eigen_assert(load_rate.size() == v.size());
    return motions.cols() > 0 &&
           PathSystem::shift * (coordinates * v).lpNorm<Eigen::Infinity>() >
             undriven * load_rate.lpNorm<Eigen::Infinity>();
  }



  void
  SchemeFactor::solve(const MatrixXd &imbalance, MatrixXd &v) const
  {
    eigen_assert(imbalance.rows() == K->rows());
    const auto n = static_cast<lapack_int>(unknown.size());
    const auto m = static_cast<lapack_int>(imbalance.cols());
    v            = MatrixXd::Zero(imbalance.rows(), m);
    if (n == 0 || m == 0)
      return;
    MatrixXd x(n, m);
    for (std::size_t a = 0; a < unknown.size(); ++a)
      {
        x.row(static_cast<Index>(a)) = imbalance.row(unknown[a]);
        if (weight[a] != 0)
          x.row(static_cast<Index>(a)) += weight[a] * imbalance.row(normal[a]);
      }
    LAPACKE_dgetrs(LAPACK_COL_MAJOR,
                   'N',
                   n,
                   m,
                   factor.data(),
                   n,
                   pivots.data(),
                   x.data(),
                   n);
    for (std::size_t a = 0; a < unknown.size(); ++a)
      v.row(unknown[a]) = x.row(static_cast<Index>(a));
  }



  /* What the scheme says of reactions holds to the last digit: K v - f would
     leave rounding in its place. */
  void
  SchemeFactor::clean(MatrixXd &r, const bool with_cohesion) const
  {
    eigen_assert(r.rows() == K->rows());
    for (Index i = 0; i < system->n_nodes(); ++i)
      {
        const auto       node = static_cast<std::size_t>(i);
        const NodeScheme s    = scheme[node];
        const Index      n = system->normal[node], t = system->tangent[node];
        if (!s.closed)
          r.row(n).setZero();
        if (t < 0)
          continue;
        if (system->is_free(i, s.closed))
          r.row(t).setZero();
        else if (s.slip != 0)
          r.row(t) = -s.slip * (system->mu(i) * r.row(n).array() +
                                (with_cohesion ? system->cohesion(i) : 0.));
      }
  }



  void
  SchemeFactor::rates(const Vector &load_rate, Vector &v, Vector &r) const
  {
    MatrixXd step;
    v = Vector::Zero(load_rate.size());
    for (int k = 0; k < n_refinements; ++k)
      {
        solve(load_rate - *K * v, step);
        v += step;
      }
    const bool in_balance = motions.cols() > 0 && !is_driven(load_rate, v);
    for (int k = 0; in_balance && k < n_refinements; ++k)
      {
        // without the springs, and without moving
        v -= motion(v);
        solve(load_rate - system->K * v, step);
        v += step - motion(step);
      }
    MatrixXd reaction = (in_balance ? system->K : *K) * v - load_rate;
    clean(reaction, false);
    r = reaction;
  }



  void
  SchemeFactor::values(const Vector &load, Vector &v, Vector &r) const
  {
    eigen_assert(load.size() == K->rows());
    eigen_assert(v.size() == K->rows());
    Vector cohesive = load;
    for (Index i = 0; i < system->n_nodes(); ++i)
      {
        const auto       node = static_cast<std::size_t>(i);
        const NodeScheme s    = scheme[node];
        if (s.closed)
          v(system->normal[node]) = 0;
        if (system->tangent[node] >= 0)
          // r_t + s mu r_n = -s c
          cohesive(system->tangent[node]) -= s.slip * system->cohesion(i);
      }
    // The residual is that of K itself: rigid motions stay where they are.
    MatrixXd step;
    for (int k = 0; k < n_refinements; ++k)
      {
        solve(cohesive - system->K * v, step);
        v += step;
        if (motions.cols() > 0)
          v -= motion(step);
      }
    MatrixXd reaction = system->K * v - load;
    clean(reaction, true);
    r = reaction;
  }



  void
  SchemeFactor::responses(const std::vector<Index> &columns,
                          MatrixXd                 &v,
                          MatrixXd                 &r) const
  {
    MatrixXd imbalance(K->rows(), static_cast<Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j)
      // A held unknown moved by 1 loads the others with its column.
      imbalance.col(static_cast<Index>(j)) = -K->col(columns[j]);
    solve(imbalance, v);
    for (std::size_t j = 0; j < columns.size(); ++j)
      v(columns[j], static_cast<Index>(j)) = 1;
    r = *K * v;
    clean(r, false);
  }
} // namespace conetact::load_path
