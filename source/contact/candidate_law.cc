// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/candidate_law.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/friction_ellipse.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    using pairing::Situation;

    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

    /** An ellipse that is next to a line leads Newton's method nowhere. */
    void
    refuse_one_axis(const pairing::ContactNode &node,
                    const double                one,
                    const double                two)
    {
      constexpr double least = 1e-4;
      if (std::min(one, two) < least * std::max(one, two))
        throw InputError(
          "A contact at " + to_text(node.position) +
          " has friction along one axis and next to none along the other one: "
          "coefficients of " +
          to_text(one) + " and " + to_text(two) +
          ", which vary. Give each a thousandth of the other one at least, or "
          "0 to both.");
    }

    /** The law sees both sides far apart. */
    solvers::Layer
    out_of_sight(const pairing::ContactNode &node)
    {
      constexpr double far = 1e3; // of an edge, and of an overlap
      solvers::Layer   layer;
      layer.closing = far * (node.spacing + std::abs(node.gap));
      return layer;
    }

    solvers::Layer
    of_spring(const pairing::ContactNode &node, const double r_n)
    {
      const double C = node.spring->compliance();
      return {C * (node.is_joined() ? r_n : std::max(r_n, 0.)), C, 0, 0, {}};
    }

    /** Of f(situation) along its pressure or its speed, in steps of a part of
     * it, or of what is little. */
    template <typename Function>
    double
    slope(const Function  &f,
          const Situation &at,
          double Situation::*const x,
          const double             little)
    {
      constexpr double part = 1e-6;
      const double     h    = part * std::max(at.*x, little);
      Situation        more = at, less = at;
      more.*x += h;
      less.*x = std::max(less.*x - h, 0.);
      return h > 0 ? (f(more) - f(less)) / (more.*x - less.*x) : 0.;
    }

    /** mu; what is below 0 is none. */
    double
    coefficient_of(const pairing::ContactNode &node,
                   const Situation            &at,
                   const unsigned int          axis)
    {
      return std::max(0., node.friction->coefficient(at, axis));
    }
  } // namespace

  CandidateLaw::CandidateLaw(const ContactPoints &p,
                             const std::size_t    i,
                             CandidateStart       start,
                             const bool           is_wet)
    : points(p)
    , number(i)
    , known(std::move(start))
    , constant({{not_known, not_known}})
    , active(node().is_active(known.situation.t))
  {
    Assert(known.duration > 0, dealii::ExcMessage("Increments take time."));
    if (!node().friction)
      constant.fill(point().mu);
    else if (node().friction->is_known())
      for (const unsigned int axis : {0, 1})
        constant[axis] = coefficient_of(node(), known.situation, axis);
    if (has_axes() && node().friction->is_known())
      refuse_one_axis(node(), constant[0], constant[1]);
    if (active && node().bond)
      bonded = CandidateBond(node(), known.situation);
    if (has_layer() && node().layer->is_linear())
      linear = {node().layer->closing_by_pressure(known.situation),
                node().layer->wears_at_once() ?
                  node().layer->wear_by_pressure(known.situation) :
                  0.,
                node().layer->shear(known.situation)};
    if (is_wet)
      fluid = node().fluid->pressure(known.situation.t) * node().covered_area();
  }

  bool
  CandidateLaw::is_soft() const
  {
    return !active || is_joined() || node().spring ||
           (node().layer && node().layer->is_soft());
  }

  /* p = r_n / area, v = |du_t| / dt. */
  Situation
  CandidateLaw::situation(const double r_n, const double slip) const
  {
    Situation here = known.situation;
    if (const double a = node().covered_area(); a > 0)
      here.pressure = std::max(r_n, 0.) / a;
    here.speed = slip / known.duration;
    return here;
  }

  solvers::FrictionLimit
  CandidateLaw::limit(const double s, const double slip, const double gap) const
  {
    return has_axes() ? mean_of(limit_along(0, s, slip, gap),
                                limit_along(1, s, slip, gap)) :
                        limit_along(0, s, slip, gap);
  }

  solvers::Aspect
  CandidateLaw::aspect(const double s,
                       const double slip,
                       const double gap) const
  {
    if (!is_elliptic())
      return {};
    return aspect_of(limit_along(0, s, slip, gap),
                     limit_along(1, s, slip, gap));
  }

  bool
  CandidateLaw::has_axes() const
  {
    return node().friction && node().friction->is_elliptic() &&
           point().normal() > point().first;
  }

  bool
  CandidateLaw::is_elliptic() const
  {
    return has_axes() && point().normal() == point().first + 2;
  }

  /** Of an ellipse: its mean semi-axis, or along the one tangent that supports
   * leave. */
  solvers::FrictionLimit
  CandidateLaw::mean_of(const solvers::FrictionLimit &one,
                        const solvers::FrictionLimit &two) const
  {
    if (is_elliptic())
      return mean(one, two);
    const Tensor<1, 3> &tangent = point().directions.front();
    return cut(one, two, tangent * node().axis_1, tangent * node().axis_2);
  }

  solvers::FrictionLimit
  CandidateLaw::limit_along(const unsigned int axis,
                            const double       s,
                            const double       slip,
                            const double       gap) const
  {
    if (!bonded.holds())
      return friction(axis, s, slip);
    const solvers::Bond pulled = pull(slip, gap);
    const double        r_n    = std::max(s, 0.) - pulled.value;
    // what does not press has the coefficient of p = 0, and less than cohesion
    solvers::FrictionLimit       sum      = friction(axis, r_n, slip);
    const solvers::FrictionLimit cohesion = bonded.friction(slip, gap);
    sum.value += cohesion.value;
    sum.by_slip += cohesion.by_slip - sum.by_force * pulled.by_slip;
    sum.by_gap = cohesion.by_gap - sum.by_force * pulled.by_gap;
    if (sum.value <= 0)
      return {};
    if (const double most =
          node().friction->largest_force(known.situation, node().bonded_area());
        sum.value > most)
      return {std::max(0., most), 0, 0, 0};
    if (s <= 0)
      sum.by_force = 0;
    return sum;
  }

  solvers::FrictionLimit
  CandidateLaw::friction(const unsigned int axis,
                         const double       r_n,
                         const double       slip) const
  {
    if (const double mu = constant[axis]; mu >= 0)
      return {mu * r_n, mu, 0};
    const auto mu = [&](const Situation &at) {
      return coefficient_of(node(), at, axis);
    };
    const Situation here = situation(r_n, slip);
    const double    now = mu(here), force = std::max(r_n, 0.);
    // of what slips hardly: some part of a cell in the increment
    const double little = 1e-6 * node().spacing / known.duration;
    const double most =
      node().friction->largest_force(here, node().covered_area());
    if (most <= 0)
      return {};
    if (now * force > most)
      return {most, 0, 0};
    const Expression      &law   = node().friction->expression(axis);
    solvers::FrictionLimit limit = {now * r_n, // a pull takes from cohesion
                                    now,
                                    0};
    if (law.uses("p"))
      limit.by_force +=
        here.pressure * slope(mu, here, &Situation::pressure, 0);
    if (law.uses("v"))
      limit.by_slip =
        force * slope(mu, here, &Situation::speed, little) / known.duration;
    return limit;
  }

  bool
  CandidateLaw::has_layer() const
  {
    return active && !node().may_part() && !node().spring && node().layer &&
           node().layer->is_soft() && node().covered_area() > 0;
  }

  solvers::Layer
  CandidateLaw::layer(const double r_n, const double slip) const
  {
    if (!active)
      return out_of_sight(node());
    if (node().may_part()) // its sides stay as the increment finds them
      return {-known.situation.gap, 0, 0, 0, {}};
    if (node().spring)
      return of_spring(node(), r_n);
    if (!has_layer())
      return {};
    solvers::Layer result =
      linear ? linear_layer(*linear, r_n, slip) : soft_layer(r_n, slip);
    if (bonded.holds() && r_n < 0) // what is glued stretches
      result.closing = result.by_force * r_n;
    if (result.shear > 0)
      result.sheared = result.shear * known.friction;
    return result;
  }

  /* C p and K p |slip| are linear in p: there is no expression to be asked, and
     no slope to be found by differences. */
  solvers::Layer
  CandidateLaw::linear_layer(const LinearLayer &of,
                             const double       r_n,
                             const double       slip) const
  {
    const double   a = node().covered_area(), p = std::max(r_n, 0.) / a;
    const double   worn = known.part_of_wear * of.wear;
    const double   C    = of.closing + slip * worn;
    solvers::Layer result;
    result.closing  = C * p;
    result.by_force = C / a;
    result.by_slip  = p * worn;
    result.shear    = of.shear / a;
    return result;
  }

  /* Closing C p and wear K p |slip|, the latter in the increment itself if it
     is asked for. */
  solvers::Layer
  CandidateLaw::soft_layer(const double r_n, const double slip) const
  {
    const double             a    = node().covered_area();
    const pairing::LayerLaw &law  = *node().layer;
    const Situation          here = situation(r_n, slip);
    const bool               now  = law.wears_at_once();
    const bool               back = law.is_unloaded(here);
    const auto               worn = [&](const Situation &at) {
      return now ? slip * known.part_of_wear * law.wear_by_pressure(at) : 0.;
    };
    const auto C = [&](const Situation &at) {
      return (back ? law.unloading_by_pressure(at) :
                     law.closing_by_pressure(at)) +
             worn(at);
    };
    const double   p = here.pressure;
    solvers::Layer result;
    result.closing = law.closing(here) + p * worn(here);
    // on the way to a solution; one where it falls is refused (pressures())
    result.by_force =
      std::max(0., C(here) + p * slope(C, here, &Situation::pressure, 0)) / a;
    if (now)
      result.by_slip =
        p * (known.part_of_wear * law.wear_by_pressure(here) +
             slope(C, here, &Situation::speed, 0) / known.duration);
    result.shear = law.shear(here) / a;
    return result;
  }

  solvers::Bond
  CandidateLaw::pull(const double slip, const double gap) const
  {
    return bonded.holds() ? bonded.with_slopes(slip, gap) :
                            solvers::Bond{-fluid, 0, 0};
  }

  double
  CandidateLaw::most_friction(const double r_n) const
  {
    const double force = r_n - fluid;
    const auto   along = [&](const unsigned int axis) {
      const double mu   = constant[axis];
      double       most = 0;
      if (force > 0)
        most =
          force *
          (mu >= 0 ?
               mu :
               node().friction->largest_coefficient(situation(force, 0), axis));
      if (bonded.holds())
        most += bonded.friction(0, 0).value;
      if (!node().friction)
        return most;
      const double area =
        bonded.holds() ? node().bonded_area() : node().covered_area();
      return std::clamp(node().friction->largest_force(known.situation, area),
                        0.,
                        most);
    };
    return has_axes() ? std::max(along(0), along(1)) : along(0);
  }

  /* A bound of mu at any pressure and speed, by intervals: where even that
     holds no load the load has no equilibrium. */
  double
  CandidateLaw::largest_coefficient() const
  {
    double most = 0;
    for (const unsigned int axis : {0U, has_axes() ? 1U : 0U})
      most =
        std::max(most,
                 constant[axis] >= 0 ?
                   constant[axis] :
                   node().friction->largest_coefficient_of_all(known.situation,
                                                               axis));
    return most;
  }

  /* The slip and gap that laws of friction and wear count. */
  solvers::SmallVector
  CandidateLaw::seen(const solvers::ContactState &end) const
  {
    AssertIndexRange(point().normal(), end.v.size());
    AssertIndexRange(point().normal(), end.r.size());
    const Eigen::Index size = point().normal() - point().first + 1;
    return solvers::see([&](const double r_n,
                            const double slip) { return layer(r_n, slip); },
                        end.v.segment(point().first, size),
                        end.r.segment(point().first, size));
  }

  /* mu = f / r_n at the end, the slope of the limit f where nothing presses. A
     fluid has its part of r_n without friction. */
  double
  CandidateLaw::coefficient(const solvers::ContactState &end) const
  {
    const double r_n = end.r[point().normal()] - fluid;
    const double way = slip_in(seen(end));
    auto         now = friction(0, r_n, way);
    if (has_axes())
      now = mean_of(now, friction(1, r_n, way));
    return r_n > 0 ? now.value / r_n : now.by_force;
  }
} // namespace conetact::contact
