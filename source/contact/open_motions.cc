// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/open_motions.h"

#include "conetact/solvers/unloaded.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** Of the largest force: what presses less presses nothing. */
    constexpr double nothing = 1e-12;

    /** Of the way: what is less is rounding. */
    constexpr double rounding = 1e-12;

    /**
     * Orthonormal basis of what rows do not see. Squares of rows tell roughly
     * what it may be, and cost little; the rows themselves what it is.
     */
    MatrixXd
    null_of(const MatrixXd &rows)
    {
      constexpr double zero = 1e-9, nearly = 1e-6; // of the largest row
      if (rows.cols() == 0 || rows.rows() == 0)
        return MatrixXd::Identity(rows.cols(), rows.cols());
      const Eigen::SelfAdjointEigenSolver<MatrixXd> squares(rows.transpose() *
                                                            rows);
      const VectorXd &values = squares.eigenvalues();
      const double    most   = std::max(1., std::sqrt(values.maxCoeff()));
      const Index    n = (values.array() <= std::pow(nearly * most, 2)).count();
      const MatrixXd near = squares.eigenvectors().leftCols(n);
      if (n == 0)
        return near;
      MatrixXd seen             = MatrixXd::Zero(std::max(rows.rows(), n), n);
      seen.topRows(rows.rows()) = rows * near;
      const Eigen::JacobiSVD<MatrixXd> svd(seen, Eigen::ComputeFullV);
      const Index n_seen = (svd.singularValues().array() > zero * most).count();
      return near * svd.matrixV().rightCols(n - n_seen);
    }
  } // namespace

  MatrixXd
  unopposed_motions(const RigidMotions                    &motions,
                    const ContactPoints                   &points,
                    const std::vector<solvers::NodeState> &states)
  {
    const solvers::ContactSystem &layout = points.layout();
    std::vector<Index>            opposing;
    for (Index i = 0; i < layout.n_nodes(); ++i)
      {
        const solvers::NodeState state = states[static_cast<std::size_t>(i)];
        if (state == solvers::NodeState::open)
          continue;
        opposing.push_back(layout.normal(i));
        if (state == solvers::NodeState::stick)
          for (Index k = 0; k < layout.n_tangents(i); ++k)
            opposing.push_back(layout.first[static_cast<std::size_t>(i)] + k);
      }
    return null_of(motions.null_space()(opposing, Eigen::all));
  }

  OpenMotions::OpenMotions(const RigidMotions          &m,
                           const ContactPoints         &points,
                           const solvers::ContactState &state,
                           const double                 largest_force)
    : motions(m)
  {
    if (motions.unresisted().cols() == 0)
      return;
    const solvers::ContactSystem &layout = points.layout();
    const MatrixXd               &seen   = motions.seen();
    std::vector<Index>            opposing, others;
    for (Index i = 0; i < layout.n_nodes(); ++i)
      {
        const Index n = layout.normal(i);
        if (state.r[n] <= nothing * largest_force)
          {
            others.push_back(n);
            continue;
          }
        opposing.push_back(n);
        if (points[i].mu > 0)
          for (Index k = points[i].first; k < n; ++k)
            opposing.push_back(k);
      }
    open = motions.unresisted() *
           null_of(seen(opposing, Eigen::all) * motions.unresisted());
    if (!exist())
      return;
    // orthonormal in the products of motions with each other
    const Eigen::SelfAdjointEigenSolver<MatrixXd> squares(
      open.transpose() * motions.products_of_free() * open);
    open *= squares.operatorInverseSqrt();
    rows = seen(others, Eigen::all) * open;
    gap  = state.v(others);
  }

  VectorXd
  OpenMotions::shortening(const VectorXd &way) const
  {
    const VectorXd so_far = motions.free_in(way);
    VectorXd       y =
      -open.transpose() * (motions.products_of_free() * so_far).eval();
    VectorXd left = gap;
    if (gap.size() > 0) // BLAS takes no empty matrix
      left += rows * y;
    const auto out = solvers::shortest_way_out(rows, left);
    if (!out)
      return {};
    const VectorXd change = open * (y + *out);
    return solvers::largest(change) <= rounding * solvers::largest(way) ?
             VectorXd() :
             change;
  }
} // namespace conetact::contact
