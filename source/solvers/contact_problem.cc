// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/contact_problem.h"

#include "conetact/solvers/cone.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /**
     * Weight of the residual over the data alone: at a tolerance of 1e-10 they
     * may be violated by 1e-6 of themselves.
     */
    constexpr double runaway = 1e-4;

    /** A stiffness that turns displacements into forces, @f$\rho@f$. */
    double
    reference_stiffness(const ContactSystem &system)
    {
      const double mean =
        system.matrix.trace() / static_cast<double>(system.n_unknowns());
      if (!(mean > 0))
        return 1.;
      return system.form == Form::stiffness ? mean : 1. / mean;
    }

    /**
     * Matrix times x. A stiffness is symmetric, half of it is enough to be
     * read; a compliance need not be.
     */
    VectorXd
    product(const ContactSystem &system, const VectorXd &x)
    {
      if (system.form == Form::compliance)
        return system.matrix * x;
      return system.matrix.selfadjointView<Eigen::Lower>() * x;
    }

    /** Residual of the linear relation, as forces. */
    VectorXd
    relation_residual(const ContactProblem &problem,
                      const ContactState   &state,
                      const double          rho)
    {
      const ContactSystem &system = *problem.system;
      if (system.form == Form::stiffness)
        return product(system, state.v) - state.r - problem.load;
      return rho * (product(system, state.r) + problem.load - state.v);
    }

    /** Residual of the contact law, as forces. */
    VectorXd
    law_residual(const ContactProblem &problem,
                 const ContactState   &state,
                 const double          rho)
    {
      const ContactSystem &system = *problem.system;
      VectorXd             result(system.n_unknowns());
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const Index       first = system.first[i], nt = system.n_tangents(i);
          const double      mu = system.mu(i);
          const SmallVector r  = state.r.segment(first, nt + 1);
          SmallVector       v  = state.v.segment(first, nt + 1);
          v(nt) += mu * v.head(nt).norm();
          result.segment(first, nt + 1) =
            r - project_on_friction_cone(r - rho * v, mu);
        }
      return result;
    }
  } // namespace

  double
  largest(const VectorXd &x)
  {
    return x.size() == 0 ? 0. : x.lpNorm<Eigen::Infinity>();
  }



  double
  contact_residual(const ContactProblem &problem, const ContactState &state)
  {
    const ContactSystem &system = *problem.system;
    if (system.n_unknowns() == 0)
      return 0;
    if (!state.v.allFinite() || !state.r.allFinite())
      return std::numeric_limits<double>::infinity();

    const double rho = reference_stiffness(system);
    const double data =
      std::max({system.form == Form::stiffness ? problem.load.norm() :
                                                 rho * problem.load.norm(),
                rho * problem.gap.norm(),
                problem.reference_force});
    const double scale = std::max({state.r.norm(),
                                   rho * state.v.norm(),
                                   rho * problem.gap.norm(),
                                   problem.reference_force});
    const double error =
      std::max(law_residual(problem, state, rho).norm(),
               relation_residual(problem, state, rho).norm());
    if (error == 0)
      return 0;
    double result = error / scale;
    if (data > 0)
      result = std::max(result, runaway * error / data);
    return std::isfinite(result) ? result :
                                   std::numeric_limits<double>::infinity();
  }



  KannoErrors
  kanno_errors(const ContactProblem &problem, const ContactState &state)
  {
    const ContactSystem &system    = *problem.system;
    const bool           stiffness = system.form == Form::stiffness;
    // The side that the linear relation gives from the other one.
    VectorXd v = state.v, r = state.r;
    if (stiffness)
      r = product(system, state.v) - problem.load;
    else
      v = product(system, state.r) + problem.load;

    double own = 0, relation = 0;
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index first = system.first[i], nt = system.n_tangents(i);
        // lambda may be anything from |du_t| on where r_n = 0
        const auto add = [&](const VectorXd &x, const VectorXd &y) {
          const double lambda = x.segment(first, nt).norm();
          return lambda * system.mu(i) * y(first + nt) +
                 x.segment(first, nt + 1).dot(y.segment(first, nt + 1));
        };
        own += add(state.v, state.r);
        relation += add(v, r);
      }
    return {own / (1 + own), relation / (1 + own)};
  }



  std::vector<NodeState>
  classify(const ContactProblem &problem,
           const ContactState   &state,
           const double          tolerance)
  {
    const ContactSystem &system = *problem.system;
    const double         limit =
      tolerance * std::max(largest(state.v), largest(problem.gap));
    std::vector<NodeState> result(static_cast<std::size_t>(system.n_nodes()));
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const double slip =
          state.v.segment(system.first[i], system.n_tangents(i)).norm();
        result[static_cast<std::size_t>(i)] = state.r(system.normal(i)) <= 0 ?
                                                NodeState::open :
                                              slip > limit ? NodeState::slip :
                                                             NodeState::stick;
      }
    return result;
  }
} // namespace conetact
