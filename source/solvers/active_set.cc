// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/active_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    std::size_t
    at(const Index i)
    {
      return static_cast<std::size_t>(i);
    }

    std::string
    stalled(const double residual)
    {
      std::ostringstream text;
      text.precision(2);
      text << "residual stalled at " << residual;
      return text.str();
    }
  } // namespace



  ActiveSet::ActiveSet(const SolverOptions &solver_options)
    : options(solver_options)
  {}



  void
  ActiveSet::attach(const ContactProblem &problem)
  {
    if (!relation || !relation->is(problem.system))
      {
        relation.emplace(problem.system);
        newton = NewtonSystem();
      }
    relation->set_load(problem);
  }



  std::vector<ActiveSet::Set>
  ActiveSet::first_sets(const ContactState &state) const
  {
    const ContactSystem &system = relation->system();
    std::vector<Set>     sets(at(system.n_nodes()));
    const Array         &scale = relation->column_scale();
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        Set        &set   = sets[at(i)];
        const Index first = system.first[i], nt = system.n_tangents(i);
        set.state = state.node.empty() ? NodeState::stick : state.node[at(i)];
        set.direction = SmallVector::Zero(nt);
        if (set.state == NodeState::open || nt == 0)
          continue;
        if (system.mu(i) == 0)
          {
            set.state = NodeState::slip;
            continue;
          }
        if (set.state == NodeState::stick)
          continue;
        // The stiffness of the node: scale is 1/sqrt(c) or sqrt(c).
        const double      c = relation->stiffness() ?
                                1 / (scale(first) * scale(first)) :
                                scale(first) * scale(first);
        const SmallVector z =
          state.r.segment(first, nt) - c * state.v.segment(first, nt);
        if (z.norm() == 0)
          {
            set.state = NodeState::stick;
            continue;
          }
        set.direction    = z.normalized();
        const bool moves = state.v.segment(first, nt).norm() > 0;
        set.ratio =
          moves ? std::min(1.,
                           std::max(0., system.mu(i) * state.r(first + nt)) /
                             z.norm()) :
                  .5;
      }
    return sets;
  }



  std::vector<ActiveSet::Set>
  ActiveSet::sets_of(const Array &p, const Array &d) const
  {
    const ContactSystem &system = relation->system();
    const Array         &v      = relation->stiffness() ? p : d;
    const Array         &r      = relation->stiffness() ? d : p;
    std::vector<Set>     sets(at(system.n_nodes()));
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index       first = system.first[i], nt = system.n_tangents(i);
        const SmallVector z =
          r.segment(first, nt + 1) - v.segment(first, nt + 1);
        Set &set      = sets[at(i)];
        set.direction = SmallVector::Zero(nt);
        if (z(nt) <= 0)
          continue;
        const double norm  = z.head(nt).norm();
        const double limit = system.mu(i) * z(nt);
        set.state          = NodeState::stick;
        if (nt == 0 || (norm <= limit && limit > 0))
          continue;
        set.state = NodeState::slip;
        if (limit > 0)
          {
            set.direction = z.head(nt) / norm;
            set.ratio     = limit / norm;
          }
      }
    return sets;
  }



  namespace
  {
    /**
     * The part of the slip law's derivative that turns with z_t. Exact would be
     * ratio (1 - e e^T), and that is what this tends to. Far from the solution
     * the reaction itself, cut back to the cone, takes the place of one e:
     * without this a node that has to slip the other way spoils the step (Hueber,
     * Stadler, Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572-596).
     */
    SmallMatrix
    turning_part(const SmallVector &e, const double ratio, const double limit, const SmallVector &reaction)
    {
      const Index n = e.size();
      if (n < 2)
        return SmallMatrix::Zero(n, n);
      const double norm  = reaction.norm();
      const double size  = limit > norm ? norm / limit : 1.;
      SmallVector  r     = SmallVector::Zero(n);
      double       cosine = 0;
      if (norm > 0)
        {
          r      = reaction * (size / norm);
          cosine = e.dot(reaction) / norm;
        }
      const double damping = cosine < 0 ? 1 / (1 - cosine * size) : 1.;
      return ratio *
             (SmallMatrix::Identity(n, n) - damping * r * e.transpose());
    }
  } // namespace



  std::vector<NodeLaw>
  ActiveSet::laws(const std::vector<Set> &sets,
                  const Array            &p,
                  const Array            &d) const
  {
    const ContactSystem &system = relation->system();
    const Array         &v      = relation->stiffness() ? p : d;
    const Array         &r      = relation->stiffness() ? d : p;
    std::vector<NodeLaw> result(sets.size());
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Set        &set   = sets[at(i)];
        const Index       first = system.first[i], nt = system.n_tangents(i);
        const SmallVector vi = v.segment(first, nt + 1);
        const SmallVector ri = r.segment(first, nt + 1);
        // A dv + B dr = h
        SmallMatrix A = SmallMatrix::Zero(nt + 1, nt + 1);
        SmallMatrix B = SmallMatrix::Zero(nt + 1, nt + 1);
        SmallVector h;
        if (set.state == NodeState::open)
          {
            B.setIdentity();
            h = -ri;
          }
        else
          {
            A.setIdentity();
            h = -vi;
          }
        if (set.state == NodeState::slip && nt > 0)
          {
            const double      mu = system.mu(i), zn = ri(nt) - vi(nt);
            const SmallMatrix T =
              turning_part(set.direction, set.ratio, mu * zn, ri.head(nt));
            A.topLeftCorner(nt, nt) = T;
            B.topLeftCorner(nt, nt) = SmallMatrix::Identity(nt, nt) - T;
            A.topRightCorner(nt, 1) = mu * set.direction;
            B.topRightCorner(nt, 1) = -A.topRightCorner(nt, 1);
            // A first guess of the states may not go with z: then the law is
            // asked for at the end of the step, not its increment.
            if (zn > 0)
              h.head(nt) = mu * zn * set.direction - ri.head(nt);
            else
              h.head(nt) = -(A.topRows(nt) * vi + B.topRows(nt) * ri);
          }
        NodeLaw &law = result[at(i)];
        law.p        = relation->stiffness() ? A : B;
        law.d        = relation->stiffness() ? B : A;
        law.h        = h;
      }
    return result;
  }



  double
  ActiveSet::law_residual(const Array &p, const Array &d) const
  {
    const ContactSystem &system = relation->system();
    const Array         &v      = relation->stiffness() ? p : d;
    const Array         &r      = relation->stiffness() ? d : p;
    double               sum    = 0;
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index       first = system.first[i], nt = system.n_tangents(i);
        const SmallVector ri    = r.segment(first, nt + 1);
        SmallVector       z     = ri - v.segment(first, nt + 1);
        const double      zn    = std::max(z(nt), 0.);
        const double      limit = system.mu(i) * zn, norm = z.head(nt).norm();
        if (norm > limit)
          z.head(nt) *= limit / norm;
        z(nt) = zn;
        sum += (ri - z).squaredNorm();
      }
    const double scale = std::max(p.norm(), d.norm());
    return scale > 0 ? std::sqrt(sum) / scale : 0.;
  }



  namespace
  {
    /** States, and signs of slip in 2D: what makes two Newton matrices equal.
     */
    template <typename Sets>
    std::string
    signature(const Sets &sets)
    {
      std::string result;
      result.reserve(sets.size());
      for (const auto &set : sets)
        {
          char c = static_cast<char>('0' + static_cast<int>(set.state));
          if (set.state == NodeState::slip && set.direction.size() == 1 &&
              set.direction(0) < 0)
            c = '-';
          result += c;
        }
      return result;
    }
  } // namespace



  SolverReport
  ActiveSet::iterate(Array &p, Array &d, std::vector<Set> &sets)
  {
    SolverReport          report;
    const double          goal = std::max(.05 * options.tolerance, 1e-14);
    std::set<std::string> seen;
    std::string           current  = signature(sets);
    double                residual = std::numeric_limits<double>::infinity();
    bool                  damped   = false;
    unsigned int          stalls   = 0;
    const Array           none     = Array::Zero(p.size());

    const auto dual = [&](const Array &q) {
      Array result = relation->load();
      relation->multiply_add(q, result);
      return result;
    };
    d = dual(p);
    while (report.iterations < options.max_iterations)
      {
        seen.insert(current);
        Array dp;
        // What Newton gains anyway, or what is left to gain if that is less.
        const double precision =
          std::min(1e-2, std::max(.1 * residual, .3 * goal / residual));
        if (!newton.solve(*relation, laws(sets, p, d), none, precision, dp))
          {
            report.reason = "singular tangent";
            return report;
          }
        ++report.iterations;

        Array  trial     = p + dp;
        Array  trial_d   = dual(trial);
        double new_value = law_residual(trial, trial_d);
        if (damped)
          for (double tau = .5; tau > .02 && !(new_value < residual); tau /= 2)
            {
              trial     = p + tau * dp;
              trial_d   = dual(trial);
              new_value = law_residual(trial, trial_d);
            }
        p = trial;
        d = trial_d;
        if (!std::isfinite(new_value))
          {
            report.reason = "singular tangent";
            return report;
          }

        sets                       = sets_of(p, d);
        const std::string next     = signature(sets);
        const bool        same     = next == current;
        const bool        improved = new_value < .5 * residual;
        current                    = next;
        residual                   = new_value;
        if (same && (residual <= goal || (!improved && stalls > 1)))
          break;
        stalls = improved ? 0 : stalls + 1;
        if (!same && seen.count(next) > 0 && !improved)
          {
            if (damped && stalls > 10)
              {
                report.reason = "cycling between state sets";
                return report;
              }
            damped = true;
          }
      }
    report.residual = residual;
    if (residual > options.tolerance)
      report.reason = stalled(residual);
    return report;
  }



  void
  ActiveSet::finish(const ContactProblem   &problem,
                    const std::vector<Set> &sets,
                    Array                  &p,
                    Array                  &d,
                    ContactState           &state,
                    SolverReport           &report) const
  {
    const ContactSystem &system = relation->system();
    Array               &v      = relation->stiffness() ? p : d;
    Array               &r      = relation->stiffness() ? d : p;
    state.node.resize(sets.size());
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index first = system.first[i], nt = system.n_tangents(i);
        NodeState  &node = state.node[at(i)];
        node             = sets[at(i)].state;
        if (node == NodeState::open)
          r.segment(first, nt + 1).setZero();
        else
          v(first + nt) = 0;
        if (node == NodeState::stick)
          v.segment(first, nt).setZero();
        if (node == NodeState::slip)
          {
            if (system.mu(i) == 0)
              r.segment(first, nt).setZero();
            if (v.segment(first, nt).isZero(0))
              node = NodeState::stick;
          }
      }
    relation->from_scaled(p, d, state);
    report.residual  = contact_residual(problem, state);
    report.converged = report.residual <= options.tolerance;
    if (!report.converged && report.reason.empty())
      report.reason = stalled(report.residual);
    if (report.converged)
      {
        report.reason.clear();
        report.solver = "active set";
      }
  }



  SolverReport
  ActiveSet::run(const ContactProblem &problem,
                 Array                &p,
                 Array                &d,
                 std::vector<Set>     &sets,
                 ContactState         &state)
  {
    const unsigned int before = newton.n_factorizations();
    SolverReport       report = iterate(p, d, sets);
    report.factorizations     = newton.n_factorizations() - before;
    finish(problem, sets, p, d, state, report);
    return report;
  }



  SolverReport
  ActiveSet::solve(const ContactProblem &problem, ContactState &state)
  {
    attach(problem);
    Array p, d;
    relation->to_scaled(state, p, d);
    std::vector<Set> sets = first_sets(state);
    return run(problem, p, d, sets, state);
  }



  SolverReport
  ActiveSet::polish(const ContactProblem &problem, ContactState &state)
  {
    attach(problem);
    Array p, d;
    relation->to_scaled(state, p, d);
    std::vector<Set> sets = sets_of(p, d);
    return run(problem, p, d, sets, state);
  }



  std::unique_ptr<ContactSolver>
  make_active_set(const SolverOptions &options)
  {
    return std::make_unique<ActiveSet>(options);
  }
} // namespace conetact
