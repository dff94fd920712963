// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/smoothing_iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    std::size_t
    number(const Index i)
    {
      return static_cast<std::size_t>(i);
    }
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
    eigen_assert(relation.has_cones() && !relation.has_layers() &&
                 !relation.has_bonds());
    const ContactSystem &system = relation.system();
    relation.to_scaled(start, x.p, x.d);
    load = relation.load();
    if (relation.stiffness())
      {
        // the unknowns of this method are v themselves
        relation.multiply_add(-relation.offset(), load);
        x.p += relation.offset();
      }
    // lambda and y = mu r_n of [K] (17) are unknowns of this form only; |du_t|
    // is the least that lambda can be.
    x.lambda       = Array::Zero(system.n_nodes());
    x.y            = Array::Zero(system.n_nodes());
    const Array &v = displacements(x);
    const Array &r = reactions(x);
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



  const SmoothingIteration::Array &
  SmoothingIteration::displacements(const Point &point) const
  {
    return relation.stiffness() ? point.p : point.d;
  }



  const SmoothingIteration::Array &
  SmoothingIteration::reactions(const Point &point) const
  {
    return relation.reactions(point.p, point.d);
  }



  SmallVector
  SmoothingIteration::cone_displacement(const Point &point, const Index i) const
  {
    const Index nt = relation.system().n_tangents(i);
    SmallVector result(nt + 1);
    result << point.lambda(i),
      displacements(point).segment(relation.system().first[i], nt);
    return result;
  }



  SmallVector
  SmoothingIteration::cone_reaction(const Point &point, const Index i) const
  {
    const Index nt = relation.system().n_tangents(i);
    SmallVector result(nt + 1);
    result << point.y(i),
      reactions(point).segment(relation.system().first[i], nt);
    return result;
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
    const Array         &v      = displacements(point);
    const Array         &r      = reactions(point);
    Defect               result;
    // d = (M + eps I) p + l: the regularised relation has one solution where M
    // is singular.
    result.relation = load + eps * point.p - point.d;
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
    const Array         &v      = displacements(point);
    const Array         &r      = reactions(point);
    const Index          first = system.first[i], nt = system.n_tangents(i);
    // x - P(x - y) of the half line, then of the second-order cone.
    const double g = v(first + nt), z = g - r(first + nt);
    const double positive =
      m_now > 0 ? smoothed_positive_part(z, m_now) : std::max(z, 0.);
    double result = (g - positive) * (g - positive);
    if (!has_cone(i))
      // without friction r_t = 0
      return result + r.segment(first, nt).squaredNorm();
    const SmallVector xc = cone_displacement(point, i);
    const SmallVector zc = xc - cone_reaction(point, i);
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
    double sum = residual.relation.squaredNorm() + residual.y.squaredNorm() +
                 point.d.tail(relation.system().n_motions).squaredNorm();
    for (Index i = 0; i < relation.system().n_nodes(); ++i)
      sum += squared_cone_residual(point, i, m_now);
    return std::sqrt(sum);
  }



  void
  SmoothingIteration::measure()
  {
    // H_NR belongs to the problem itself: neither smoothed nor regularised.
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
    const Array         &v      = displacements(x);
    const Array         &r      = reactions(x);
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
        const SmallVector z = cone_displacement(x, i) - cone_reaction(x, i);
        const Spectrum    s = spectrum(z);
        take(s.l1);
        take(s.l2);
      }
    return result;
  }



  /**
   * The pivot is what multiplies dlambda in the first row of the cone, once dy
   * is replaced.
   */
  SmoothingIteration::Cone
  SmoothingIteration::linearize_cone(const Index i) const
  {
    // lambda is undetermined at open nodes: its pivot vanishes with m and eps,
    // and a step along it would blow up.
    const SmallVector        xc = cone_displacement(x, i);
    const SmoothedProjection projected =
      smoothed_projection(xc - cone_reaction(x, i), m);
    Cone cone;
    cone.phi    = xc - projected.value;
    cone.C      = projected.complement;
    cone.D      = projected.derivative;
    cone.pivot  = cone.C(0, 0) + eps * cone.D(0, 0);
    cone.frozen = cone.pivot < options.frozen_pivot;
    return cone;
  }



  /**
   * C (dlambda, dv_t) + D (dy, dr_t) = -phi without its first row, from which
   * dlambda follows, and with dy = mu dr_n - shift dg + eps dlambda + defect.
   */
  SmoothingIteration::Law
  SmoothingIteration::law_of(const Index  i,
                             const Cone  &cone,
                             const double y_defect) const
  {
    const ContactSystem &system = relation.system();
    const Array         &v = displacements(x), &r = reactions(x);
    const Index          first = system.first[i], nt = system.n_tangents(i);
    Law                  law{SmallMatrix::Zero(nt + 1, nt + 1),
            SmallMatrix::Zero(nt + 1, nt + 1),
            SmallVector(nt + 1)};

    // The half line of gap and normal reaction: its row has no lambda.
    const double             z = v(first + nt) - r(first + nt);
    const SmoothedProjection n =
      smoothed_projection(SmallVector::Constant(1, z), m);
    law.A(nt, nt) = n.complement(0, 0);
    law.B(nt, nt) = n.derivative(0, 0);
    law.h(nt)     = n.value(0) - v(first + nt);
    if (!has_cone(i))
      {
        law.B.topLeftCorner(nt, nt).setIdentity();
        law.h.head(nt) = -r.segment(first, nt);
        return law;
      }

    const SmallMatrix &C = cone.C, &D = cone.D;
    // q times the first row is subtracted from the others. With lambda frozen,
    // dlambda = 0 and there is nothing to subtract.
    SmallVector q = SmallVector::Zero(nt);
    if (!cone.frozen)
      q = (C.col(0).tail(nt) + eps * D.col(0).tail(nt)) / cone.pivot;
    const SmallVector w = D.col(0).tail(nt) - q * D(0, 0);
    law.A.topLeftCorner(nt, nt) =
      C.bottomRightCorner(nt, nt) - q * C.topRightCorner(1, nt);
    law.B.topLeftCorner(nt, nt) =
      D.bottomRightCorner(nt, nt) - q * D.topRightCorner(1, nt);
    law.A.topRightCorner(nt, 1) = -normal_shift(i) * w;
    law.B.topRightCorner(nt, 1) = system.mu(i) * w;
    law.h.head(nt) = -cone.phi.tail(nt) + q * cone.phi(0) - w * y_defect;
    return law;
  }



  /** Completes a direction by what was eliminated: lambda and y. */
  void
  SmoothingIteration::recover(const std::vector<Cone> &cones,
                              const Defect            &residual,
                              Point                   &delta) const
  {
    eigen_assert(static_cast<Index>(cones.size()) ==
                 relation.system().n_nodes());
    const ContactSystem &system = relation.system();
    const Array         &v = displacements(delta), &r = reactions(delta);
    delta.lambda = Array::Zero(system.n_nodes());
    delta.y      = Array::Zero(system.n_nodes());
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        if (!has_cone(i))
          continue;
        const Cone  &cone  = cones[number(i)];
        const Index  first = system.first[i], nt = system.n_tangents(i);
        const double y = system.mu(i) * r(first + nt) -
                         normal_shift(i) * v(first + nt) + residual.y(i);
        if (!cone.frozen)
          delta.lambda(i) =
            -(cone.phi(0) + cone.C.row(0).tail(nt).dot(v.segment(first, nt)) +
              cone.D(0, 0) * y +
              cone.D.row(0).tail(nt).dot(r.segment(first, nt))) /
            cone.pivot;
        delta.y(i) = y + eps * delta.lambda(i);
      }
  }



  /* Newton's direction of H = 0: node by node the laws A dv + B dr = h without
     lambda and y, then dd = (M + eps) dp + rho of all nodes, then lambda and y
     again. The system has no unknown more than the relation itself. */
  bool
  SmoothingIteration::direction(const Defect &residual, Point &delta)
  {
    const Index          n = relation.system().n_nodes();
    std::vector<NodeLaw> laws(number(n));
    std::vector<Cone>    cones(number(n));
    for (Index i = 0; i < n; ++i)
      {
        if (has_cone(i))
          cones[number(i)] = linearize_cone(i);
        const Law law = law_of(i, cones[number(i)], residual.y(i));
        NodeLaw  &out = laws[number(i)];
        out.p         = relation.stiffness() ? law.A : law.B;
        out.d         = relation.stiffness() ? law.B : law.A;
        out.h         = law.h;
      }
    append_balance(relation, x.d, laws);
    for (NodeLaw &law : laws)
      // dd = (M + eps) dp + rho, and NewtonSystem knows M only.
      law.p += eps * law.d; // P + D (M + eps) = (P + eps D) + D M
    if (!newton.solve(
          relation, laws, residual.relation, options.precision, delta.p))
      return false;
    ++iterations;
    delta.d = residual.relation + eps * delta.p;
    relation.multiply_add(delta.p, delta.d);
    recover(cones, residual, delta);
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
        // The relation is linear in the point: what a step leaves of it is
        // known, and computed anew would be round-off.
        const Defect left{(1 - tau) * residual.relation,
                          (1 - tau) * residual.y};
        const double value = merit(trial, left, m);
        // The full step where it comes into the neighbourhood |H| <= beta; else
        // Armijo on |H|^2, as Newton's direction has the slope -2 |H|^2.
        const bool good =
          (cuts == 0 && value <= beta) ||
          value * value <= (1 - 2 * options.sigma * tau) * start * start;
        if (!good && cuts < 30)
          continue;
        if (!good)
          {
            why =
              "no step along its direction, however short, lessens the error";
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
    const double k = static_cast<double>(outer);
    const double h = natural;
    // mbar keeps the derivative of the smoothed projection near one of the
    // projection itself: quadratic convergence needs that.
    double bar = std::numeric_limits<double>::infinity();
    if (options.kappahat * h < 1)
      bar = .5 * smallest_eigenvalue() * std::sqrt(options.kappahat * h);
    const double power = std::pow(options.etabar, k);
    m    = std::min({options.kappa * h * h, options.m0 * power, bar});
    eps  = std::min(options.kappa * h * h, options.eps0 * power);
    beta = options.beta0 * std::pow(options.eta, k);
    // Below these the linear systems lose more digits than are gained.
    m   = std::max(m, options.smallest_m);
    eps = std::max(eps, options.smallest_eps);
  }



  /* It gives up where 30 steps in a row have not taken a tenth off the least
     residual: steps of an inner loop may well raise it for a while. */
  bool
  SmoothingIteration::advance(const double target)
  {
    while (natural > target)
      {
        if (options.stop && options.stop())
          {
            why = "stopped by the limit of time";
            return false;
          }
        if (iterations >= static_cast<unsigned int>(options.max_iterations) ||
            stalls > 30 || !std::isfinite(natural))
          {
            why = stalled(natural);
            return false;
          }
        if (!step())
          return false;
        measure();
        stalls = natural < .9 * best ? 0 : stalls + 1;
        best   = std::min(best, natural);
        // m, eps and beta move only once the inner loop has reached its |H| <=
        // beta.
        if (!inside)
          shrink();
      }
    return true;
  }



  void
  SmoothingIteration::get(ContactState &state) const
  {
    // p of the relation is the elastic part u = v - o.
    Array p = x.p;
    if (relation.stiffness())
      p -= relation.offset();
    relation.from_scaled(p, x.d, state);
  }
} // namespace conetact::solvers
