// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The laws of a problem's nodes, as its methods ask for them.

#include "conetact/solvers/contact_problem.h"

namespace conetact::solvers
{
  using Eigen::Index;
  using Eigen::VectorXd;

  FrictionLimit
  friction_limit(const ContactProblem &problem,
                 const Index           i,
                 const double          r_n,
                 const double          slip,
                 const double          gap)
  {
    eigen_assert(i >= 0);
    eigen_assert(!(slip < 0) && !(gap < 0));
    eigen_assert(i < problem.system->n_nodes());
    if (problem.laws)
      return problem.laws->limit(i, r_n, slip, gap);
    const double mu = problem.system->mu(i);
    return {mu * r_n, mu, 0};
  }

  /* The coefficient of a node that nothing presses is the slope of its limit at
     r_n = 0, which f / r_n tends to. */
  double
  friction_coefficient(const ContactProblem &problem,
                       const ContactState   &state,
                       const Index           i)
  {
    eigen_assert(i >= 0 && i < problem.system->n_nodes());
    eigen_assert(state.r.size() >= problem.system->n_contact_unknowns());
    eigen_assert(!problem.laws ||
                 state.v.size() >= problem.system->n_contact_unknowns());
    const ContactSystem &system = *problem.system;
    if (!problem.laws)
      return system.mu(i);
    const double      r_n   = state.r(system.normal(i));
    const Index       first = system.first[i], size = system.n_tangents(i) + 1;
    const SmallVector seen = see(
      [&](const double force, const double slip) {
        return problem.laws->layer(i, force, slip);
      },
      state.v.segment(first, size),
      state.r.segment(first, size));
    const double        slip  = seen.head(size - 1).norm();
    const FrictionLimit limit = problem.laws->limit(i, r_n, slip, 0);
    return r_n > 0 ? limit.value / r_n : limit.by_force;
  }

  VectorXd
  seen_by_law(const ContactProblem &problem,
              const VectorXd       &v,
              const VectorXd       &r)
  {
    eigen_assert(v.size() >= problem.system->n_contact_unknowns());
    eigen_assert(v.size() == r.size());
    const ContactSystem &system = *problem.system;
    VectorXd             seen   = v;
    if (!problem.laws || !problem.laws->has_layers())
      return seen;
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index first = system.first[i], size = system.n_tangents(i) + 1;
        seen.segment(first, size) = see(
          [&](const double r_n, const double slip) {
            return problem.laws->layer(i, r_n, slip);
          },
          v.segment(first, size),
          r.segment(first, size));
      }
    return seen;
  }

  /* Layers are linear about the state: w(r_n) = w_0 + c (r_n - r_n,0) adds c to
     W_nn and w_0 - c r_n,0 to q_n; shear adds C_t to the diagonal and takes w_t
     from q_t. In stiffness form there is no diagonal that compliances add to.
   */
  ContactProblem
  with_coefficients_of(const ContactState &state, const ContactProblem &problem)
  {
    eigen_assert(!problem.laws ||
                 state.v.size() == problem.system->n_unknowns());
    ContactProblem result = problem;
    if (!problem.laws)
      return result;
    auto system = std::make_shared<ContactSystem>(*problem.system);
    for (Index i = 0; i < system->n_nodes(); ++i)
      {
        const Index first = system->first[i], n = system->normal(i);
        system->mu(i) = friction_coefficient(problem, state, i);
        if (!problem.laws->has_layers() || system->form != Form::compliance)
          continue;
        const Layer layer =
          problem.laws->layer(i,
                              state.r(n),
                              state.v.segment(first, n - first).norm());
        for (Index k = first; k < n; ++k)
          system->matrix(k, k) += layer.shear;
        if (layer.sheared.size() > 0)
          result.load.segment(first, n - first) -= layer.sheared;
        system->matrix(n, n) += layer.by_force;
        result.load(n) += layer.closing - layer.by_force * state.r(n);
      }
    result.system = system;
    result.laws   = {};
    return result;
  }
} // namespace conetact::solvers
