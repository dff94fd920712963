// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/large_operator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    // Precisions of linear systems: the first one decides about the states of
    // all nodes, those after it gain as much as Newton's method does.
    constexpr double first_precision = 1e-3, least_precision = 3e-2,
                     best_precision = 1e-4;

    /** The part of the tolerance that the iteration aims at for directions. */
    constexpr double askew_aim = .6;

    /**
     * The part of the slip law that turns is at most this over one that does
     * not: a node that hardly slips would rule the residual of linear systems
     * else. Newton's matrix alone has it, the solution has not.
     */
    constexpr double largest_ratio = .9;

    double
    largest_norm(const VectorXd &a, const VectorXd &b, const double c)
    {
      return std::max({a.norm(), b.norm(), c});
    }

    /** The problem as its contact unknowns see it. */
    ContactProblem
    of_contact(const ContactProblem &problem)
    {
      ContactProblem result = problem;
      result.load = problem.load.tail(problem.system->n_unknowns()).eval();
      return result;
    }
  } // namespace



  LargeOperator::LargeOperator(std::shared_ptr<const ContactSystem> system,
                               const double tolerance_of_residuals)
    : numbers(std::move(system))
    , tolerance(tolerance_of_residuals)
  {
    eigen_assert(numbers.system().large);
  }



  void
  LargeOperator::set_load(const ContactProblem &problem)
  {
    eigen_assert(problem.load.size() == body().n_own());
    numbers.set_load(of_contact(problem));
    whole_load      = body().keep(problem.load);
    load_of_contact = problem.load.tail(problem.system->n_unknowns());
    force           = problem.reference_force;
  }



  double
  LargeOperator::product(const Kept &x, const Kept &y) const
  {
    return body().product_elsewhere(x, y) +
           body().of_contact(x).dot(body().of_contact(y));
  }

  double
  LargeOperator::norm(const Kept &x) const
  {
    return std::sqrt(product(x, x));
  }



  /* f = K u - b is the reaction at contacts and the imbalance elsewhere, whose
     norm is compared with the forces of contacts. Where these are less than
     those of the history `scale` says by how much: the residual over forces
     that are there is larger then. */
  NewtonPoint
  LargeOperator::point_at(Kept u, Kept f) const
  {
    NewtonPoint point;
    const Array r = body().of_contact(f);
    numbers.to_scaled({{}, r, {}, body().of_contact(u)}, point.p, point.d);
    point.law    = law_residual(numbers, point.p, point.d);
    double scale = largest_norm(r, load_of_contact, force);
    if (scale == 0) // nothing touches, and nothing ever has
      scale = norm(whole_load);
    const double left = std::sqrt(body().product_elsewhere(f, f));
    point.balance     = left > 0 ? left / scale : 0.;
    point.u           = std::move(u);
    point.f           = std::move(f);
    if (const double there = largest_norm(r, load_of_contact, 0); there > 0)
      point.scale = std::max(scale / there, 1.);
    return point;
  }



  NewtonPoint
  LargeOperator::point_at(Kept u) const
  {
    Kept f = body().add(body().multiply(u), -1, whole_load);
    return point_at(std::move(u), std::move(f));
  }



  /* P dp + D dd = h with du = alpha s dp, dr = alpha / s dd, and all of it
     times alpha / s: P / s^2 du + D dr = alpha / s h, where D keeps its numbers
     and the system needs no scales. */
  std::vector<NodeLaw>
  LargeOperator::laws(const NewtonPoint &point, NodeSets sets) const
  {
    eigen_assert(static_cast<Index>(sets.size()) == numbers.system().n_nodes());
    for (NodeSet &set : sets)
      set.ratio = std::min(set.ratio, largest_ratio);
    std::vector<NodeLaw> result =
      linearized_laws(numbers, sets, point.p, point.d, true);
    for (Index i = 0; i < numbers.system().n_nodes(); ++i)
      {
        const double scale = numbers.column_scale()(numbers.system().first[i]);
        NodeLaw     &law   = result[static_cast<std::size_t>(i)];
        law.p /= scale * scale;
        law.h *= numbers.unit() / scale;
      }
    return result;
  }



  std::optional<NewtonPoint>
  LargeOperator::step(const NodeSets    &sets,
                      const NewtonPoint &from,
                      const double       precision,
                      SolverReport      &report)
  {
    if (!resist_motions(numbers.system(), sets))
      return {};
    return forced_step(sets, from, precision, report);
  }



  std::optional<NewtonPoint>
  LargeOperator::forced_step(const NodeSets    &sets,
                             const NewtonPoint &from,
                             const double       precision,
                             SolverReport      &report)
  {
    eigen_assert(precision > 0);
    // Before any contact has carried anything, what they will carry is unknown.
    const bool is_known =
      !from.d.isZero(0) || !load_of_contact.isZero(0) || force > 0;
    const double forces =
      is_known ? std::max(numbers.force_scale(from.p, from.d), force) : 0.;
    const auto found =
      body().solve(laws(from, sets), from.f, {precision, forces});
    if (!found)
      return {};
    report.krylov += found->iterations;
    return point_at(body().add(from.u, 1, found->du));
  }



  NewtonPoint
  LargeOperator::between(const NewtonPoint &from,
                         const NewtonPoint &to,
                         const double       tau) const
  {
    const auto on_the_way = [&](const Kept &x, const Kept &y) {
      return body().add(x, tau, body().add(y, -1, x));
    };
    return point_at(on_the_way(from.u, to.u), on_the_way(from.f, to.f));
  }



  /* The second choice of Eisenstat and Walker, .9 gain^1.5, but no better than
     what is still to be gained. Cut steps are solved to the end: a direction
     that is not exact need not lead down. */
  double
  LargeOperator::precision(const NewtonPoint    &point,
                           const NewtonProgress &progress) const
  {
    if (progress.damped)
      return exact;
    if (progress.first)
      // Without any reaction so far it makes all of them.
      return point.d.isZero(0) ? best_precision : first_precision;
    return std::clamp(std::max(.9 * std::pow(progress.gain, 1.5),
                               .3 * progress.goal / point.residual()),
                      best_precision,
                      least_precision);
  }



  /* As long as residuals fall, directions of friction that are not exact enough
     get better, too. */
  bool
  LargeOperator::may_gain(const NewtonPoint    &point,
                          const NewtonProgress &progress) const
  {
    constexpr double slow_gain = .8;
    const double     askew     = std::max(progress.goal, askew_aim * tolerance);
    return (progress.has_improved() &&
            point.residual() * point.scale > progress.goal) ||
           (progress.gain < slow_gain &&
            askew_friction(numbers, point.sets, point.p, point.d, tolerance) >
              askew);
  }



  Patience
  LargeOperator::patience() const
  {
    Patience patience;
    patience.noise         = noise;
    patience.stalls        = 8;
    patience.leaves_cycles = true;
    return patience;
  }



  void
  LargeOperator::write(const NewtonPoint &point, ContactState &state) const
  {
    const Index n = numbers.system().n_unknowns();
    numbers.from_scaled(point.p, point.d, state);
    // Exact zeros of v = u + o are those of u without offset; of a large one
    // they are rounded, and would take u out of its balance.
    const bool has_offset = state.u.size() == n;
    state.u               = body().numbers(point.u);
    if (!has_offset)
      state.u.tail(n) = state.v;
  }
} // namespace conetact::solvers
