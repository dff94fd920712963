// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/dense_operator.h"

#include <algorithm>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    // Where so many steps are not enough, the load is near its limit or states
    // do not settle: then what a step leaves open matters.
    constexpr unsigned int exact_from = 12;

    // Friction that falls faster than bodies resist leads to and fro: so many
    // steps in a row that gain next to nothing are cut, and end if cut.
    constexpr unsigned int most_in_vain = 12;
  } // namespace



  DenseOperator::DenseOperator(std::shared_ptr<const ContactSystem> system)
    : numbers(std::move(system))
  {}



  DenseOperator::Array
  DenseOperator::dual(const Array &p) const
  {
    Array d = numbers.load();
    numbers.multiply_add(p, d);
    return d;
  }



  NewtonPoint
  DenseOperator::point_at(const Array &p) const
  {
    NewtonPoint point;
    point.p   = p;
    point.d   = dual(p);
    point.law = law_residual(numbers, point.p, point.d);
    return point;
  }



  std::vector<NodeLaw>
  DenseOperator::laws_at(const NodeSets &sets, const NewtonPoint &point) const
  {
    return linearized_laws(
      numbers, sets, point.p, point.d, false, has_own_slopes);
  }



  bool
  DenseOperator::is_balanced(const NewtonPoint &point) const
  {
    constexpr double small = 1e-6; // More left means motion without end.
    return point.d.tail(numbers.system().n_motions).norm() <=
           small * numbers.force_scale(point.p, point.d);
  }



  std::optional<NewtonPoint>
  DenseOperator::solve(const NodeSets    &sets,
                       const NewtonPoint &from,
                       const double       precision,
                       const bool         regularised,
                       SolverReport      &report)
  {
    const unsigned int before = newton.n_factorizations();
    Array              dp;
    const bool         solved = newton.solve(numbers,
                                     laws_at(sets, from),
                                     Array::Zero(from.p.size()),
                                     precision,
                                     dp,
                                     regularised);
    report.factorizations += newton.n_factorizations() - before;
    if (!solved)
      return {};
    NewtonPoint end = point_at(from.p + dp);
    return numbers.has_cones() && !numbers.has_layers() ?
             end :
             corrected(sets, std::move(end));
  }



  /* Where states stay, a step of laws beyond cones squares what is left; so do
     two or three with its factors, which cost next to nothing: a chord gains
     what the step before it has gained. None is taken far from a solution, as
     chords would settle there what the next step changes, nor where one gains
     little. */
  NewtonPoint
  DenseOperator::corrected(const NodeSets &sets, NewtonPoint point)
  {
    constexpr unsigned int most = 4;
    constexpr double       near = 1e-4, gain = .1, noise = 1e-15;
    if (point.law > near)
      return point;
    const std::string states = signature(sets);
    for (unsigned int i = 0;
         i < most && newton.has_factors() && point.law > noise;
         ++i)
      {
        const NodeSets now = sets_of_point(numbers, point.p, point.d);
        Array          dp;
        if (signature(now) != states ||
            !newton.solve_again(numbers, laws_at(now, point), dp))
          break;
        NewtonPoint next = point_at(point.p + dp);
        if (!(next.law < gain * point.law))
          break;
        point = std::move(next);
      }
    return point;
  }



  /* A regularised matrix always has a solution. It is worth something only if
     motions are in balance there. */
  std::optional<NewtonPoint>
  DenseOperator::step(const NodeSets    &sets,
                      const NewtonPoint &from,
                      const double       precision,
                      SolverReport      &report)
  {
    if (numbers.system().n_motions == 0)
      return solve(sets, from, precision, true, report);
    auto end = solve(sets, from, precision, false, report);
    if (end)
      return end;
    end = solve(sets, from, precision, true, report);
    if (end && !is_balanced(*end))
      end.reset();
    return end;
  }



  std::optional<NewtonPoint>
  DenseOperator::forced_step(const NodeSets    &sets,
                             const NewtonPoint &from,
                             const double       precision,
                             SolverReport      &report)
  {
    return solve(sets, from, precision, true, report);
  }



  NewtonPoint
  DenseOperator::between(const NewtonPoint &from,
                         const NewtonPoint &to,
                         const double       tau) const
  {
    return point_at(from.p + tau * (to.p - from.p));
  }



  /* A step squares the residual, so that a tenth of it is exact enough for the
     next linear system, and so is what takes it below the goal; two digits are
     the least. */
  double
  DenseOperator::precision(const NewtonPoint    &point,
                           const NewtonProgress &progress) const
  {
    if (progress.iterations >= exact_from)
      return 0;
    const double residual = point.residual();
    return std::min(1e-2,
                    std::max(.1 * residual, .3 * progress.goal / residual));
  }



  /* With one tangent and cones the laws of a set are linear: a step from the
     same states ends at the solution. Cones in space have directions of slip,
     which converge quadratically and are never known to be exact. Laws beyond
     cones are exact to rounding where a gain shows such convergence. */
  bool
  DenseOperator::is_exact(const NewtonProgress &progress) const
  {
    constexpr double     quadratic = 1e-3; // what is left squares in such steps
    const ContactSystem &system    = numbers.system();
    if (!numbers.has_cones())
      return progress.same && progress.gain < quadratic;
    return progress.same && system.n_contact_unknowns() <= 2 * system.n_nodes();
  }



  /* A step of a small system costs nothing, and squares what is left. Of laws
     beyond cones nothing is left of one that gets so far. */
  bool
  DenseOperator::may_gain(const NewtonPoint & /*point*/,
                          const NewtonProgress &progress) const
  {
    const bool is_enough =
      is_exact(progress) || (progress.same && !numbers.has_cones());
    return progress.has_improved() && !is_enough && newton.was_small();
  }



  Patience
  DenseOperator::patience() const
  {
    Patience patience;
    patience.noise       = 1e-13;
    patience.same_states = 2;
    patience.cycles      = 10;
    if (!numbers.has_cones())
      patience.stalls = most_in_vain;
    return patience;
  }



  void
  DenseOperator::write(const NewtonPoint &point, ContactState &state) const
  {
    numbers.from_scaled(point.p, point.d, state);
  }
} // namespace conetact::solvers
