// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/smoothing_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

    /** (axis, tangents) of the second-order cone. */
    SmallVector
    cone_vector(const double    axis,
                const VectorXd &x,
                const Index     first,
                const Index     nt)
    {
      SmallVector result(nt + 1);
      result << axis, x.segment(first, nt);
      return result;
    }

    /**
     * The linearised cone of one node with lambda and y eliminated:
     * A dv + B dr = h for the tangents, and what gives lambda back.
     */
    struct Cone
    {
      SmallMatrix C, D; ///< I - P' and P'
      SmallVector phi;  ///< x - P(x - y)
      double      pivot  = 0;
      bool        frozen = false;
    };
  } // namespace



  SmoothingIteration::SmoothingIteration(const LinearRelation &linear_relation,
                                         const SmoothingOptions &smoothing,
                                         const ContactState     &start)
    : relation(linear_relation)
    , options(smoothing)
    , m(options.m0)
    , eps(options.eps0)
    , beta(options.beta0)
  {
    const ContactSystem &system = relation.system();
    relation.to_scaled(start, x.p, x.d);
    x.lambda = Array::Zero(system.n_nodes());
    x.y      = Array::Zero(system.n_nodes());
    if (!options.scaled)
      {
        x.p.setZero();
        x.d.setZero();
      }
    const Array &v = relation.stiffness() ? x.p : x.d;
    const Array &r = relation.stiffness() ? x.d : x.p;
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        x.lambda(i) = v.segment(system.first[i], system.n_tangents(i)).norm();
        x.y(i)      = system.mu(i) * r(system.normal(i));
      }
    measure();
    best = natural;
  }



  bool
  SmoothingIteration::has_cone(const Index i) const
  {
    return relation.system().mu(i) > 0 && relation.system().n_tangents(i) > 0;
  }



  /** y = mu (r_n - eps g) + eps lambda: the first row of M x + q + eps x. */
  double
  SmoothingIteration::normal_shift(const Index i) const
  {
    return relation.stiffness() ? relation.system().mu(i) * eps : 0.;
  }



  SmoothingIteration::Defect
  SmoothingIteration::defect(const Point &point) const
  {
    const ContactSystem &system = relation.system();
    const Array         &v      = relation.stiffness() ? point.p : point.d;
    const Array         &r      = relation.stiffness() ? point.d : point.p;
    Defect               result;
    result.relation = relation.load() + eps * point.p - point.d;
    relation.multiply_add(point.p, result.relation);
    result.y = Array::Zero(system.n_nodes());
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (has_cone(i))
        result.y(i) = system.mu(i) * r(system.normal(i)) +
                      eps * point.lambda(i) -
                      normal_shift(i) * v(system.normal(i)) - point.y(i);
    return result;
  }



  double
  SmoothingIteration::squared_cone_residual(const Point &point,
                                            const Index  i,
                                            const double m_now) const
  {
    const ContactSystem &system = relation.system();
    const Array         &v      = relation.stiffness() ? point.p : point.d;
    const Array         &r      = relation.stiffness() ? point.d : point.p;
    const Index          first = system.first[i], nt = system.n_tangents(i);
    const double         g = v(first + nt), z = g - r(first + nt);
    const double         positive =
      m_now > 0 ? smoothed_positive_part(z, m_now) : std::max(z, 0.);
    double result = (g - positive) * (g - positive);
    if (!has_cone(i))
      return result + r.segment(first, nt).squaredNorm();
    const SmallVector xc = cone_vector(point.lambda(i), v, first, nt);
    const SmallVector zc = xc - cone_vector(point.y(i), r, first, nt);
    const SmallVector projected =
      m_now > 0 ? smoothed_projection(zc, m_now).value : project(zc);
    return result + (xc - projected).squaredNorm();
  }



  /** |H|, H the residuals of cones and relation together. */
  double
  SmoothingIteration::merit(const Point  &point,
                            const Defect &residual,
                            const double  m_now) const
  {
    double sum = residual.relation.squaredNorm() + residual.y.squaredNorm();
    for (Index i = 0; i < relation.system().n_nodes(); ++i)
      sum += squared_cone_residual(point, i, m_now);
    return std::sqrt(sum);
  }



  void
  SmoothingIteration::measure()
  {
    const double kept = eps;
    eps               = 0;
    natural           = merit(x, defect(x), 0);
    eps               = kept;
    if (!std::isfinite(natural))
      natural = std::numeric_limits<double>::infinity();
  }



  /** Smallest non-zero |eigenvalue| of x - y over all cones. */
  double
  SmoothingIteration::smallest_eigenvalue() const
  {
    const ContactSystem &system = relation.system();
    const Array         &v      = relation.stiffness() ? x.p : x.d;
    const Array         &r      = relation.stiffness() ? x.d : x.p;
    double               result = std::numeric_limits<double>::infinity();
    const auto           take   = [&](const double l) {
      if (std::abs(l) > 1e-300)
        result = std::min(result, std::abs(l));
    };
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index first = system.first[i], nt = system.n_tangents(i);
        take(v(first + nt) - r(first + nt));
        if (!has_cone(i))
          continue;
        const SmallVector z = cone_vector(x.lambda(i), v, first, nt) -
                              cone_vector(x.y(i), r, first, nt);
        const Spectrum s = spectrum(z);
        take(s.l1);
        take(s.l2);
      }
    return result;
  }



  bool
  SmoothingIteration::direction(const Defect &residual, Point &delta)
  {
    const ContactSystem &system = relation.system();
    const Array         &v      = relation.stiffness() ? x.p : x.d;
    const Array         &r      = relation.stiffness() ? x.d : x.p;
    // lambda is undetermined at open nodes: its pivot vanishes with m and eps,
    // and a step along it would blow up.
    const double freeze = options.scaled ? 1e-8 : 0.;

    std::vector<NodeLaw> laws(at(system.n_nodes()));
    std::vector<Cone>    cones(laws.size());
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index       first = system.first[i], nt = system.n_tangents(i);
        const double      mu = system.mu(i);
        SmallMatrix       A  = SmallMatrix::Zero(nt + 1, nt + 1);
        SmallMatrix       B  = SmallMatrix::Zero(nt + 1, nt + 1);
        SmallVector       h(nt + 1);
        const SmallVector gap =
          SmallVector::Constant(1, v(first + nt) - r(first + nt));
        const SmoothedProjection n = smoothed_projection(gap, m);
        A(nt, nt)                  = n.complement(0, 0);
        B(nt, nt)                  = n.derivative(0, 0);
        h(nt)                      = n.value(0) - v(first + nt);
        if (!has_cone(i))
          {
            B.topLeftCorner(nt, nt).setIdentity();
            h.head(nt) = -r.segment(first, nt);
          }
        else
          {
            Cone             &c  = cones[at(i)];
            const SmallVector xc = cone_vector(x.lambda(i), v, first, nt);
            const SmallVector zc = xc - cone_vector(x.y(i), r, first, nt);
            const SmoothedProjection projected = smoothed_projection(zc, m);
            c.phi                              = xc - projected.value;
            c.C                                = projected.complement;
            c.D                                = projected.derivative;
            c.pivot                            = c.C(0, 0) + eps * c.D(0, 0);
            c.frozen                           = c.pivot < freeze;

            SmallVector q = SmallVector::Zero(nt);
            if (!c.frozen)
              q = (c.C.col(0).tail(nt) + eps * c.D.col(0).tail(nt)) / c.pivot;
            const SmallVector w     = c.D.col(0).tail(nt) - q * c.D(0, 0);
            const SmallMatrix C0    = c.C.topRightCorner(1, nt),
                              D0    = c.D.topRightCorner(1, nt);
            A.topLeftCorner(nt, nt) = c.C.bottomRightCorner(nt, nt) - q * C0;
            B.topLeftCorner(nt, nt) = c.D.bottomRightCorner(nt, nt) - q * D0;
            A.topRightCorner(nt, 1) = -normal_shift(i) * w;
            B.topRightCorner(nt, 1) = mu * w;
            h.head(nt) = -c.phi.tail(nt) + q * c.phi(0) - w * residual.y(i);
          }
        NodeLaw &law = laws[at(i)];
        law.p        = relation.stiffness() ? A : B;
        law.d        = relation.stiffness() ? B : A;
        law.h        = h;
        law.p += eps * law.d;
      }

    if (!newton.solve(relation, laws, residual.relation, 1e-5, delta.p))
      return false;
    ++iterations;
    delta.d = residual.relation + eps * delta.p;
    relation.multiply_add(delta.p, delta.d);

    const Array &dv = relation.stiffness() ? delta.p : delta.d;
    const Array &dr = relation.stiffness() ? delta.d : delta.p;
    delta.lambda    = Array::Zero(system.n_nodes());
    delta.y         = Array::Zero(system.n_nodes());
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (has_cone(i))
        {
          const Cone  &c     = cones[at(i)];
          const Index  first = system.first[i], nt = system.n_tangents(i);
          const double y = system.mu(i) * dr(first + nt) -
                           normal_shift(i) * dv(first + nt) + residual.y(i);
          if (!c.frozen)
            delta.lambda(i) =
              (-c.phi(0) - c.C.row(0).tail(nt).dot(dv.segment(first, nt)) -
               c.D(0, 0) * y - c.D.row(0).tail(nt).dot(dr.segment(first, nt))) /
              c.pivot;
          delta.y(i) = y + eps * delta.lambda(i);
        }
    return delta.p.allFinite() && delta.d.allFinite() &&
           delta.lambda.allFinite();
  }



  /** One Newton step: the full one if it is good enough, else Armijo. */
  bool
  SmoothingIteration::step()
  {
    const Defect residual = defect(x);
    const double start    = merit(x, residual, m);
    Point        delta;
    if (!direction(residual, delta))
      {
        why = "singular tangent";
        return false;
      }

    double tau = 1;
    for (int cuts = 0;; ++cuts, tau *= options.rho)
      {
        Point trial = x;
        trial.lambda += tau * delta.lambda;
        trial.y += tau * delta.y;
        trial.p += tau * delta.p;
        trial.d += tau * delta.d;
        const Defect left{(1 - tau) * residual.relation,
                          (1 - tau) * residual.y};
        const double value = merit(trial, left, m);
        const bool   good =
          (cuts == 0 && value <= beta) ||
          value * value <= (1 - 2 * options.sigma * tau) * start * start;
        if (!good && cuts < 30)
          continue;
        if (!good)
          {
            why = "no descent in the line search";
            return false;
          }
        x      = trial;
        inside = value > beta;
        return true;
      }
  }



  /** The next m, eps and beta. */
  void
  SmoothingIteration::shrink()
  {
    ++outer;
    const double k   = static_cast<double>(outer);
    const double h   = natural;
    double       bar = std::numeric_limits<double>::infinity();
    if (options.kappahat * h < 1)
      bar = .5 * smallest_eigenvalue() * std::sqrt(options.kappahat * h);
    const double power = std::pow(options.etabar, k);
    m    = std::min({options.kappa * h * h, options.m0 * power, bar});
    eps  = std::min(options.kappa * h * h, options.eps0 * power);
    beta = options.beta0 * std::pow(options.eta, k);
    m    = std::max(m, options.scaled ? 1e-14 : 1e-16);
    eps  = std::max(eps, options.scaled ? 1e-13 : 0.);
  }



  bool
  SmoothingIteration::advance(const double target)
  {
    while (natural > target)
      {
        if (iterations >= static_cast<unsigned int>(options.max_iterations) ||
            stalls > 30 || !std::isfinite(natural))
          {
            std::ostringstream text;
            text.precision(2);
            text << "residual stalled at " << natural;
            why = text.str();
            return false;
          }
        if (!step())
          return false;
        measure();
        stalls = natural < .9 * best ? 0 : stalls + 1;
        best   = std::min(best, natural);
        if (!inside)
          shrink();
      }
    return true;
  }



  void
  SmoothingIteration::get(ContactState &state) const
  {
    relation.from_scaled(x.p, x.d, state);
  }



  SmoothingNewton::SmoothingNewton(const SolverOptions &solver_options)
    : options(solver_options)
    , active_set(solver_options)
  {}



  SolverReport
  SmoothingNewton::solve(const ContactProblem &problem, ContactState &state)
  {
    if (!relation || !relation->is(problem.system))
      relation.emplace(problem.system, options.smoothing.scaled);
    relation->set_load(problem);

    SmoothingIteration iteration(*relation, options.smoothing, state);
    // A residual of the scaled form is relative to the largest load, which may
    // be smaller than the reactions: the check below is the one that counts.
    const bool   done = iteration.advance(options.tolerance);
    SolverReport report;
    report.iterations     = iteration.n_iterations();
    report.factorizations = iteration.n_factorizations();
    iteration.get(state);
    report.residual = contact_residual(problem, state);
    if (!options.smoothing.scaled)
      {
        report.converged = done;
        state.node       = classify(problem, state, 1e-8);
      }
    else
      {
        ContactState       exact  = state;
        const SolverReport polish = active_set.polish(problem, exact);
        report.iterations += polish.iterations;
        report.factorizations += polish.factorizations;
        if (polish.converged)
          {
            state           = exact;
            report.residual = polish.residual;
          }
        else
          state.node = classify(problem, state, 1e-8);
        report.converged = report.residual <= options.tolerance;
      }
    if (report.converged)
      report.solver = "smoothing";
    else
      report.reason = iteration.failure();
    if (!report.converged && report.reason.empty())
      report.reason = "residual stalled";
    return report;
  }



  std::unique_ptr<ContactSolver>
  make_smoothing_newton(const SolverOptions &options)
  {
    return std::make_unique<SmoothingNewton>(options);
  }
} // namespace conetact
