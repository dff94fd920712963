// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/linear_relation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /**
     * Mean diagonal entry of each node, one a node. A node that nothing holds
     * (or a rigid one) takes the mean of all.
     */
    VectorXd
    mean_diagonal(const ContactSystem &system)
    {
      const Index  n = system.n_nodes();
      const double all =
        system.n_unknowns() > 0 ?
          system.matrix.trace() / static_cast<double>(system.n_unknowns()) :
          1.;
      const double mean = all > 0 ? all : 1.;
      VectorXd     result(n);
      for (Index i = 0; i < n; ++i)
        {
          const Index  first = system.first[i], dim = system.n_tangents(i) + 1;
          const double m = system.matrix.diagonal().segment(first, dim).sum() /
                           static_cast<double>(dim);
          result(i) = m > 1e-12 * mean ? m : mean;
        }
      return result;
    }

    /** y += columns of A x, four at a time: one pass over y for four of A. */
    void
    add_columns(const Eigen::MatrixXd    &A,
                const std::vector<Index> &columns,
                const VectorXd           &x,
                VectorXd                 &y)
    {
      const Index n = A.rows();
      std::size_t k = 0;
      for (; k + 4 <= columns.size(); k += 4)
        {
          const double *a[4];
          double        c[4];
          for (std::size_t i = 0; i < 4; ++i)
            {
              a[i] = A.col(columns[k + i]).data();
              c[i] = x(columns[k + i]);
            }
          double *out = y.data();
          for (Index i = 0; i < n; ++i)
            out[i] +=
              c[0] * a[0][i] + c[1] * a[1][i] + c[2] * a[2][i] + c[3] * a[3][i];
        }
      for (; k < columns.size(); ++k)
        y += x(columns[k]) * A.col(columns[k]);
    }
  } // namespace



  LinearRelation::LinearRelation(std::shared_ptr<const ContactSystem> system,
                                 const bool                           scaled)
    : contact_system(std::move(system))
    , has_units(!scaled)
    , scale(contact_system->n_unknowns())
    , scaled_load(contact_system->n_unknowns())
  {
    if (has_units)
      {
        scale.setOnes();
        return;
      }
    const VectorXd mean = mean_diagonal(*contact_system);
    for (Index i = 0; i < mean.size(); ++i)
      scale.segment(contact_system->first[i], contact_system->n_tangents(i) + 1)
        .setConstant(1 / std::sqrt(mean(i)));
  }



  void
  LinearRelation::set_load(const ContactProblem &problem)
  {
    // Both M = S A S and l = +-S load with S = diag(scale)
    scaled_load = scale.cwiseProduct(problem.load);
    if (stiffness())
      scaled_load = -scaled_load;
    if (has_units)
      return;
    alpha = scaled_load.size() > 0 ? scaled_load.lpNorm<Eigen::Infinity>() : 0.;
    // Forces over sqrt(c): in compliance form scale is sqrt(c) itself.
    if (scale.size() > 0)
      {
        const double mean = scale.mean();
        alpha =
          std::max(alpha,
                   problem.reference_force * (stiffness() ? mean : 1 / mean));
      }
    if (!(alpha > 0))
      alpha = 1;
    scaled_load /= alpha;
  }



  void
  LinearRelation::multiply_add(const Array &x, Array &y) const
  {
    const Array        sx = scale.cwiseProduct(x);
    std::vector<Index> columns;
    columns.reserve(static_cast<std::size_t>(sx.size()));
    for (Index i = 0; i < sx.size(); ++i)
      if (sx(i) != 0)
        columns.push_back(i);
    if (columns.empty())
      return;

    Array product = Array::Zero(sx.size());
    if (!stiffness() && 2 * static_cast<Index>(columns.size()) > sx.size())
      product.noalias() += contact_system->matrix * sx; // may be unsymmetric
    else if (2 * static_cast<Index>(columns.size()) > sx.size())
      // half of the matrix is enough
      product.noalias() +=
        contact_system->matrix.selfadjointView<Eigen::Lower>() * sx;
    else
      add_columns(contact_system->matrix, columns, sx, product);
    y += scale.cwiseProduct(product);
  }



  void
  LinearRelation::to_scaled(const ContactState &state, Array &p, Array &d) const
  {
    const Array &primary = stiffness() ? state.v : state.r;
    const Array &dual    = stiffness() ? state.r : state.v;
    p                    = primary.cwiseQuotient(scale) / alpha;
    d                    = dual.cwiseProduct(scale) / alpha;
  }



  void
  LinearRelation::from_scaled(const Array  &p,
                              const Array  &d,
                              ContactState &state) const
  {
    Array &primary = stiffness() ? state.v : state.r;
    Array &dual    = stiffness() ? state.r : state.v;
    primary        = alpha * p.cwiseProduct(scale);
    dual           = alpha * d.cwiseQuotient(scale);
  }
} // namespace conetact
