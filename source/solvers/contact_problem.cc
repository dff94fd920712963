// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/contact_problem.h"

#include "conetact/solvers/cone.h"
#include "conetact/solvers/large_system.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /**
     * Weight of the residual over the data alone: at a tolerance of 1e-10 they
     * may be violated by 1e-6 of themselves. Where no solution exists, forces
     * run away and would hide any violation.
     */
    constexpr double runaway = 1e-4;

    /** A stiffness of each node that turns displacements into forces. */
    VectorXd
    reference_stiffness(const ContactSystem &system)
    {
      const Index    n        = system.n_contact_unknowns();
      const VectorXd diagonal = system.diagonal();
      const double   mean     = n > 0 ? diagonal.head(n).mean() : 0.;
      VectorXd       rho(n);
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const Index size = system.n_tangents(i) + 1;
          double      d    = diagonal.segment(system.first[i], size).mean();
          // A node that nothing holds (or a rigid one) has no stiffness of its
          // own: any factor will do.
          if (!(d > 1e-12 * mean))
            d = mean > 0 ? mean : 1.;
          rho.segment(system.first[i], size)
            .setConstant(system.form == Form::stiffness ? d : 1 / d);
        }
      return rho;
    }

    /**
     * What positions are known to, in compliance form: v is a difference of
     * them. In stiffness form it is the solver's own unknown.
     */
    VectorXd
    velocity_rounding(const ContactProblem &problem, const ContactState &state)
    {
      const ContactSystem &system = *problem.system;
      const Index          n      = system.n_contact_unknowns();
      if (system.form == Form::stiffness)
        return VectorXd::Zero(n);
      const Index k = system.n_motions;
      return position_rounding *
             (problem.load.head(n).cwiseAbs() +
              system.matrix.topRightCorner(n, k).cwiseAbs() *
                state.r.tail(k).cwiseAbs());
    }

    /** What a layer closes by is taken from a displacement of its size: of
     * stiff bodies on a soft layer its rounding alone would be a force. */
    VectorXd
    rounding_of_layers(const ContactProblem &problem, const ContactState &state)
    {
      const ContactSystem &system = *problem.system;
      VectorXd             result = VectorXd::Zero(system.n_contact_unknowns());
      for (Index i = 0; problem.has_layers() && i < system.n_nodes(); ++i)
        {
          const Index first = system.first[i], n = system.normal(i);
          const Layer layer =
            problem.laws->layer(i,
                                state.r(n),
                                state.v.segment(first, n - first).norm());
          result(n) = position_rounding * std::abs(layer.closing);
          for (Index k = first; k < n; ++k)
            result(k) = position_rounding * layer.shear * std::abs(state.r(k));
        }
      return result;
    }

    /** Displacements among the data, entry by entry as far as known. */
    VectorXd
    displacements_given(const ContactProblem &problem)
    {
      const ContactSystem &system = *problem.system;
      const Index          n      = system.n_contact_unknowns();
      VectorXd             given  = VectorXd::Zero(n);
      if (system.form == Form::compliance)
        given = problem.load.head(n).cwiseAbs();
      else if (problem.offset.size() > 0)
        given = problem.offset.cwiseAbs();
      for (Index i = 0; i < problem.gap.size(); ++i)
        given(system.normal(i)) =
          std::max(given(system.normal(i)), problem.gap(i));
      return given;
    }

    /** Reactions that hold the displacements of the stiffness form. */
    VectorXd
    reactions_of(const ContactProblem &problem, const ContactState &state)
    {
      const ContactSystem &system = *problem.system;
      const VectorXd       u      = elastic_part(problem, state);
      if (system.large)
        return system.large->of_contact(
                 system.large->multiply(system.large->keep(u))) -
               problem.load.tail(system.n_unknowns());
      return multiply(system, u) - problem.load;
    }

    /** Of reactions, over the largest one: what a node carries is known to this
     * only. */
    constexpr double rounding_of_forces = 1e-14;

    /** True if friction is at its limit, but for what forces are rounded by. It
     * is asked for where layers give way: what they take of a slip is known to
     * rounding only, and leaves no zero. */
    bool
    may_slip(const ContactProblem &problem,
             const Index           i,
             const double          r_n,
             const double          r_t,
             const double          slip,
             const double          rounding)
    {
      constexpr double at_limit = 1e-11;
      if (!problem.has_layers() || problem.laws->layer(i, r_n, slip).is_none())
        return true;
      const double s = r_n + problem.laws->bond(i, slip, 0).value;
      return r_t + rounding >=
             (1 - at_limit) * friction_limit(problem, i, s, slip).value;
    }

    /** The norm of the load over all unknowns of a large system. */
    double
    norm_of_all(const ContactProblem &problem)
    {
      const LargeSystem      &large = *problem.system->large;
      const LargeSystem::Kept load  = large.keep(problem.load);
      return std::sqrt(
        large.product_elsewhere(load, load) +
        problem.load.tail(problem.system->n_unknowns()).squaredNorm());
    }

    /** Residual of the linear relation, as forces: K u - f - r, or W r + q - v
     * times the stiffness of each node, and the imbalance of motions. */
    VectorXd
    relation_residual(const ContactProblem &problem,
                      const ContactState   &state,
                      const VectorXd       &rho)
    {
      const ContactSystem &system = *problem.system;
      if (system.form == Form::stiffness)
        return reactions_of(problem, state) - state.r;
      const Index n        = system.n_contact_unknowns();
      VectorXd    residual = multiply(system, state.r) + problem.load - state.v;
      residual.head(n)     = rho.cwiseProduct(
        without_rounding(residual.head(n), velocity_rounding(problem, state)));
      return residual;
    }

    /** s = r_n + b, which laws have in place of r_n, at v as the law sees it.
     */
    double
    with_bond(const ContactProblem &problem,
              const Index           i,
              const double          r_n,
              const SmallVector    &v)
    {
      const Index nt = v.size() - 1;
      return problem.is_bonded(i) ?
               r_n +
                 problem.laws->bond(i, v.head(nt).norm(), std::max(v(nt), 0.))
                   .value :
               r_n;
    }

    /** The ellipse of node i at v, as the law sees it, and pressed by s. */
    Aspect
    aspect_of(const ContactProblem &problem,
              const Index           i,
              const double          s,
              const SmallVector    &v)
    {
      if (!problem.has_ellipses())
        return {};
      const Index nt = v.size() - 1;
      return problem.laws->aspect(i, s, v.head(nt).norm(), std::max(v(nt), 0.));
    }

    /** r - P(r - factor v) of a node with a bond, or whose limit is an ellipse,
     * at v as the law sees it: not the nearest point, but friction is cut back
     * to its limit. */
    SmallVector
    bonded_residual(const ContactProblem &problem,
                    const Index           i,
                    const double          factor,
                    SmallVector           r,
                    const SmallVector    &v)
    {
      const Index  nt   = v.size() - 1;
      const double slip = v.head(nt).norm(), gap = std::max(v(nt), 0.);
      r(nt) += problem.laws->bond(i, slip, gap).value;
      const SmallVector scale = aspect_of(problem, i, r(nt), v).scale(nt + 1);
      r                       = r.cwiseQuotient(scale).eval();
      SmallVector  z          = r - factor * scale.cwiseProduct(v);
      const double zn         = std::max(z(nt), 0.);
      const double limit      = friction_limit(problem, i, zn, slip, gap).value;
      if (const double norm = z.head(nt).norm(); norm > limit)
        z.head(nt) *= limit / norm;
      z(nt) = zn;
      return scale.cwiseProduct(r - z);
    }

    /**
     * Residual of the contact law, as forces, r - P_C(r - rho v'); that of
     * motions is balance. A node that moves as a part of a floating body may
     * slip so far that rho v' has no digit left of r: the law holds with any
     * rho > 0, and a smaller one is taken there.
     */
    VectorXd
    law_residual(const ContactProblem &problem,
                 const ContactState   &state,
                 const VectorXd       &rho)
    {
      const ContactSystem &system = *problem.system;
      const Index          n      = system.n_contact_unknowns();
      const VectorXd       closest =
        without_rounding(seen_by_law(problem, state.v.head(n), state.r.head(n)),
                         velocity_rounding(problem, state) +
                           rounding_of_layers(problem, state));
      VectorXd result(system.n_unknowns());
      result.tail(system.n_motions) = state.v.tail(system.n_motions);
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const Index       first = system.first[i], nt = system.n_tangents(i);
          const double      mu   = friction_coefficient(problem, state, i);
          const SmallVector r    = state.r.segment(first, nt + 1);
          SmallVector       v    = closest.segment(first, nt + 1);
          const double      slip = v.head(nt).norm(), gap = v(nt);
          double            factor = rho(first);
          if (factor * slip > longest_slip * r.norm() && r.norm() > 0)
            // Slip fixes no more than the direction of friction.
            factor = longest_slip * r.norm() / slip;
          if (problem.is_apart(i))
            {
              result.segment(first, nt + 1) = r;
              continue;
            }
          if (problem.is_joined(i))
            {
              result.segment(first, nt + 1) = rho(first) * v;
              continue;
            }
          if (problem.is_bonded(i) || problem.has_ellipses())
            {
              result.segment(first, nt + 1) =
                bonded_residual(problem, i, factor, r, v);
              continue;
            }
          // With g + mu |du_t| in place of g the whole law is one projection on
          // the cone (de Saxce and Feng).
          v(nt) += mu * slip;
          result.segment(first, nt + 1) =
            r - project_on_friction_cone(r - factor * v, mu);
          // With the smaller factor a gap beside a reaction would hardly count:
          // it is added, an interference in full, an open gap up to |r|.
          if (factor < rho(first))
            result(first + nt) += gap > 0 ?
                                    std::min(rho(first) * gap, r.norm()) :
                                    -rho(first) * gap;
        }
      return result;
    }
  } // namespace

  VectorXd
  without_rounding(const VectorXd &x, const VectorXd &allowed)
  {
    eigen_assert(x.size() == allowed.size());
    return x.binaryExpr(allowed, [](const double value, const double limit) {
      return value > limit  ? value - limit :
             value < -limit ? value + limit :
                              0.;
    });
  }

  VectorXd
  multiply(const ContactSystem &system, const VectorXd &x)
  {
    eigen_assert(!system.large);
    eigen_assert(x.size() == system.n_unknowns());
    if (system.n_unknowns() == 0) // which BLAS does not take
      return x;
    if (system.form == Form::stiffness) // half of the matrix is enough
      return system.matrix.selfadjointView<Eigen::Lower>() * x;
    return system.matrix * x;
  }

  VectorXd
  elastic_part(const ContactProblem &problem, const ContactState &state)
  {
    if (problem.offset.size() == 0)
      return state.v;
    return state.u.size() > 0 ? state.u : VectorXd(state.v - problem.offset);
  }

  double
  largest(const VectorXd &x)
  {
    return x.size() == 0 ? 0. : x.lpNorm<Eigen::Infinity>();
  }



  double
  contact_residual(const ContactProblem &problem, const ContactState &state)
  {
    eigen_assert(state.node.empty() || static_cast<Index>(state.node.size()) ==
                                         problem.system->n_nodes());
    eigen_assert(state.r.size() >= problem.system->n_contact_unknowns());
    const ContactSystem &system = *problem.system;
    if (system.n_unknowns() == 0)
      return 0;
    if (!state.v.allFinite() || !state.r.allFinite())
      return std::numeric_limits<double>::infinity();

    const VectorXd rho   = reference_stiffness(system);
    const Index    n     = system.n_contact_unknowns();
    const bool     stiff = system.form == Form::stiffness;
    const double   error =
      std::max(law_residual(problem, state, rho).norm(),
               relation_residual(problem, state, rho).norm());
    if (error == 0)
      return 0;
    const double load = problem.load.tail(stiff ? n : system.n_motions).norm();
    const double scale =
      std::max({state.r.head(n).norm(), load, problem.reference_force});
    // In large systems loads may act elsewhere, which contacts feel only once
    // they hold: reactions that grow to their size do not run away.
    const double all = system.large ? norm_of_all(problem) : load;
    const double data =
      std::max({all,
                problem.reference_force,
                rho.cwiseProduct(displacements_given(problem)).norm()});
    double result = error / scale;
    if (data > 0)
      result = std::max(result, runaway * error / data);
    return std::isfinite(result) ? result :
                                   std::numeric_limits<double>::infinity();
  }



  /* x.y = sum_i lambda_i mu_i r_n,i + v_i.r_i with lambda_i = |du_t,i|: of the
     state's own v and r (err1), and with one of them replaced by what the
     linear relation gives (err2). */
  KannoErrors
  kanno_errors(const ContactProblem &problem, const ContactState &state)
  {
    eigen_assert(state.v.size() == problem.system->n_unknowns());
    eigen_assert(state.r.size() == problem.system->n_unknowns());
    const ContactSystem &system    = *problem.system;
    const bool           stiffness = system.form == Form::stiffness;
    // The side that the linear relation gives from the other one.
    const VectorXd seen = seen_by_law(problem, state.v, state.r);
    VectorXd       v = state.v, r = state.r;
    if (stiffness)
      r = reactions_of(problem, state);
    else
      v = multiply(system, state.r) + problem.load;

    v = seen_by_law(problem, v, r);

    double own = 0, relation = 0;
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index  first = system.first[i], nt = system.n_tangents(i);
        const double mu = friction_coefficient(problem, state, i);
        // Where r_n = 0, lambda may be more than |du_t|, but does not count.
        const auto add = [&](const VectorXd &x, const VectorXd &y) {
          const SmallVector at = x.segment(first, nt + 1);
          const SmallVector scale =
            aspect_of(problem, i, with_bond(problem, i, y(first + nt), at), at)
              .scale(nt + 1);
          const double lambda = scale.cwiseProduct(at).head(nt).norm();
          return lambda * mu * y(first + nt) + at.dot(y.segment(first, nt + 1));
        };
        own += add(seen, state.r);
        relation += add(v, r);
      }
    return {own / (1 + own), relation / (1 + own)};
  }



  void
  add_work(SolverReport &total, const SolverReport &part)
  {
    total.iterations += part.iterations;
    total.factorizations += part.factorizations;
    total.krylov += part.krylov;
  }



  std::string
  stalled(const double residual)
  {
    std::ostringstream text;
    text.precision(2);
    text << "residual stalled at " << residual;
    return text.str();
  }



  std::vector<NodeState>
  classify(const ContactProblem &problem,
           const ContactState   &state,
           const double          tolerance)
  {
    eigen_assert(state.r.size() >= problem.system->n_contact_unknowns());
    const ContactSystem &system = *problem.system;
    const Index          n      = system.n_contact_unknowns();
    const VectorXd       seen =
      seen_by_law(problem, state.v.head(n), state.r.head(n));
    const double limit =
      tolerance * std::max(largest(seen), largest(problem.gap));
    const double rounding = rounding_of_forces * largest(state.r.head(n));
    // A node with a bond b is open where its gap times the stiffness is more
    // than the force that presses it, r_n + b <= rho g: neither is zero to the
    // last digit.
    const VectorXd rho =
      problem.has_bonds() ? reference_stiffness(system) : VectorXd();
    const auto bond_opens = [&](const Index i, const double slip) {
      const Index  k   = system.normal(i);
      const double gap = seen(k);
      return gap > 0 && state.r(k) + problem.laws->bond(i, slip, gap).value <=
                          rho(k) * gap;
    };
    std::vector<NodeState> result(static_cast<std::size_t>(system.n_nodes()));
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        if (problem.is_joined(i) || problem.is_apart(i))
          {
            result[static_cast<std::size_t>(i)] =
              problem.is_apart(i) ? NodeState::open : NodeState::stick;
            continue;
          }
        const Index       first = system.first[i], nt = system.n_tangents(i);
        const double      slip = seen.segment(first, nt).norm();
        const double      r_n  = state.r(first + nt);
        const SmallVector at   = seen.segment(first, nt + 1);
        const double      r_t =
          state.r.segment(first, nt + 1)
            .cwiseQuotient(
              aspect_of(problem, i, with_bond(problem, i, r_n, at), at)
                .scale(nt + 1))
            .head(nt)
            .norm();
        const bool slips =
          slip > limit && may_slip(problem, i, r_n, r_t, slip, rounding);
        const bool opens =
          problem.is_bonded(i) ? bond_opens(i, slip) : r_n <= 0;
        result[static_cast<std::size_t>(i)] = opens ? NodeState::open :
                                              slips ? NodeState::slip :
                                                      NodeState::stick;
      }
    return result;
  }
} // namespace conetact::solvers
