// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/increment_laws.h"

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
  } // namespace

  IncrementLaws::IncrementLaws(const ContactPoints     &p,
                               std::vector<Situation>   known,
                               const Eigen::VectorXd   &r,
                               const double             duration,
                               const std::vector<bool> &wet)
    : points(p)
    , start(std::move(known))
    , r_start(r)
    , time(duration)
    , constant(start.size(), {{not_known, not_known}})
    , active(start.size(), true)
    , joined(start.size(), false)
    , strength(start.size(), 0.)
    , cohesion(start.size(), 0.)
    , fluids(start.size(), 0.)
    , bonds(start.size(), false)
    , soft(false)
    , bonded(false)
    , elliptic(false)
  {
    Assert(r_start.size() >= points.n_unknowns(),
           dealii::ExcMessage("Each candidate has a reaction at the start."));
    Assert(wet.empty() || wet.size() == points.size(),
           dealii::ExcMessage("Each candidate is wet or not."));
    AssertDimension(start.size(), points.size());
    Assert(time > 0, dealii::ExcMessage("Increments take time."));
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const pairing::ContactNode &node = *points[i].node;
        if (!node.friction)
          constant[i].fill(points[i].mu);
        else if (node.friction->is_known())
          for (const unsigned int axis : {0, 1})
            constant[i][axis] = coefficient(i, start[i], axis);
        elliptic = elliptic || is_elliptic(i);
        if (has_axes(i) && node.friction->is_known())
          refuse_one_axis(node, constant[i][0], constant[i][1]);
        active[i] = node.is_active(start[i].t);
        joined[i] = active[i] && node.is_joined();
        if (active[i] && node.bond)
          {
            strength[i] = node.bond->strength(start[i]) * node.bonded_area();
            cohesion[i] = node.bond->cohesion(start[i]) * node.bonded_area();
            bonds[i]    = rest(i, 0, 0) * (strength[i] + cohesion[i]) > 0;
          }
        if (i < wet.size() && wet[i])
          fluids[i] = node.fluid->pressure(start[i].t) * node.covered_area();
        bonded = bonded || bonds[i] || is_wet(i) || joined[i];
        soft   = soft || !active[i] || joined[i] || node.spring ||
               (node.layer && node.layer->is_soft());
      }
  }

  /* A copy that wears by a part of the coefficient: an increment solved in
     halves tells how far Wear acceleration is off. */
  std::shared_ptr<const IncrementLaws>
  IncrementLaws::with_wear(const double part) const
  {
    Assert(part >= 0, dealii::ExcMessage("Nothing grows by wear."));
    const auto result    = std::make_shared<IncrementLaws>(*this);
    result->part_of_wear = part;
    return result;
  }

  /* What the law of a node sees at an iterate: p = r_n / area, v = |du_t| / dt;
     place, time, temperature and the way so far are those of the increment. */
  Situation
  IncrementLaws::situation(const std::size_t i,
                           const double      r_n,
                           const double      slip) const
  {
    AssertIndexRange(i, start.size());
    Situation here = start[i];
    if (const double a = points[i].node->covered_area(); a > 0)
      here.pressure = std::max(r_n, 0.) / a;
    here.speed = slip / time;
    return here;
  }

  /** mu; what is below 0 is none. */
  double
  IncrementLaws::coefficient(const std::size_t  i,
                             const Situation   &at,
                             const unsigned int axis) const
  {
    return std::max(0., points[i].node->friction->coefficient(at, axis));
  }

  solvers::FrictionLimit
  IncrementLaws::limit(const Index  node,
                       const double s,
                       const double slip,
                       const double gap) const
  {
    const auto i = static_cast<std::size_t>(node);
    AssertIndexRange(i, start.size());
    return has_axes(i) ? mean_of(i,
                                 limit_along(i, 0, s, slip, gap),
                                 limit_along(i, 1, s, slip, gap)) :
                         limit_along(i, 0, s, slip, gap);
  }

  solvers::Aspect
  IncrementLaws::aspect(const Index  node,
                        const double s,
                        const double slip,
                        const double gap) const
  {
    const auto i = static_cast<std::size_t>(node);
    AssertIndexRange(i, start.size());
    if (!is_elliptic(i))
      return {};
    return aspect_of(limit_along(i, 0, s, slip, gap),
                     limit_along(i, 1, s, slip, gap));
  }

  bool
  IncrementLaws::has_axes(const std::size_t i) const
  {
    const pairing::ContactNode &node = *points[i].node;
    return node.friction && node.friction->is_elliptic() &&
           points[i].normal() > points[i].first;
  }

  bool
  IncrementLaws::is_elliptic(const std::size_t i) const
  {
    return has_axes(i) && points[i].normal() == points[i].first + 2;
  }

  /** Of an ellipse: its mean semi-axis, or along the one tangent that supports
   * leave. */
  solvers::FrictionLimit
  IncrementLaws::mean_of(const std::size_t             i,
                         const solvers::FrictionLimit &one,
                         const solvers::FrictionLimit &two) const
  {
    if (is_elliptic(i))
      return mean(one, two);
    const pairing::ContactNode &node    = *points[i].node;
    const Tensor<1, 3>         &tangent = points[i].directions.front();
    return cut(one, two, tangent * node.axis_1, tangent * node.axis_2);
  }

  solvers::FrictionLimit
  IncrementLaws::limit_along(const std::size_t  i,
                             const unsigned int axis,
                             const double       s,
                             const double       slip,
                             const double       gap) const
  {
    if (!bonds[i])
      return friction(i, axis, s, slip);
    const solvers::Bond pulled = bond(static_cast<Index>(i), slip, gap);
    const double        r_n    = std::max(s, 0.) - pulled.value;
    const double        c      = cohesion[i];
    // what does not press has the coefficient of p = 0, and less than cohesion
    solvers::FrictionLimit sum  = friction(i, axis, r_n, slip);
    const auto             left = [&](const double ds, const double g) {
      return rest(i, ds, g);
    };
    sum.value += c * left(slip, gap);
    // The rest of a bond is piecewise linear in opening and slip. A difference
    // over a step that is rounding to both is its slope to the right, from a
    // kink on as well.
    const double h = step_of(i);
    sum.by_slip += c * (left(slip + h, gap) - left(slip, gap)) / h -
                   sum.by_force * pulled.by_slip;
    sum.by_gap = c * (left(slip, gap + h) - left(slip, gap)) / h -
                 sum.by_force * pulled.by_gap;
    if (sum.value <= 0)
      return {};
    const pairing::ContactNode &at = *points[i].node;
    if (const double most =
          at.friction->largest_force(start[i], at.bonded_area());
        sum.value > most)
      return {std::max(0., most), 0, 0, 0};
    if (s <= 0)
      sum.by_force = 0;
    return sum;
  }

  solvers::FrictionLimit
  IncrementLaws::friction(const std::size_t  i,
                          const unsigned int axis,
                          const double       r_n,
                          const double       slip) const
  {
    if (const double known = constant[i][axis]; known >= 0)
      return {known * r_n, known, 0};
    const auto mu = [&](const Situation &at) {
      return coefficient(i, at, axis);
    };
    const Situation here = situation(i, r_n, slip);
    const double    now = mu(here), force = std::max(r_n, 0.);
    // of what slips hardly: some part of a cell in the increment
    const double little = 1e-6 * points[i].node->spacing / time;
    const double most =
      points[i].node->friction->largest_force(here,
                                              points[i].node->covered_area());
    if (most <= 0)
      return {};
    if (now * force > most)
      return {most, 0, 0};
    const Expression      &law   = points[i].node->friction->expression(axis);
    solvers::FrictionLimit limit = {now * r_n, // a pull takes from cohesion
                                    now,
                                    0};
    if (law.uses("p"))
      limit.by_force +=
        here.pressure * slope(mu, here, &Situation::pressure, 0);
    if (law.uses("v"))
      limit.by_slip = force * slope(mu, here, &Situation::speed, little) / time;
    return limit;
  }

  /* Closing C p and wear K p |slip|, the latter in the increment itself if it
     is asked for. */
  solvers::Layer
  IncrementLaws::layer(const Index  node,
                       const double r_n,
                       const double slip) const
  {
    const auto i = static_cast<std::size_t>(node);
    AssertIndexRange(i, start.size());
    const ContactPoint &point = points[i];
    const double        a     = points[i].node->covered_area();
    if (!active[i])
      return out_of_sight(*point.node);
    if (point.node->may_part()) // its sides stay as the increment finds them
      return {-start[i].gap, 0, 0, 0, {}};
    if (point.node->spring)
      return of_spring(*point.node, r_n);
    if (!point.node->layer || !point.node->layer->is_soft() || a == 0)
      return {};
    const pairing::LayerLaw &law  = *point.node->layer;
    const Situation          here = situation(i, r_n, slip);
    const bool               now  = law.wears_at_once();
    const bool               back = law.is_unloaded(here);
    const auto               worn = [&](const Situation &at) {
      return now ? slip * part_of_wear * law.wear_by_pressure(at) : 0.;
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
    if (bonds[i] && r_n < 0) // what is glued stretches
      result.closing = result.by_force * r_n;
    if (now)
      result.by_slip = p * (part_of_wear * law.wear_by_pressure(here) +
                            slope(C, here, &Situation::speed, 0) / time);
    result.shear = law.shear(here) / a;
    if (result.shear > 0)
      result.sheared = result.shear * friction_at_start(i);
    return result;
  }

  /** What softens does so in the increment; what breaks, at its end. */
  double
  IncrementLaws::rest(const std::size_t i,
                      const double      slip,
                      const double      gap) const
  {
    AssertIndexRange(i, start.size());
    Assert(points[i].node->bond != nullptr,
           dealii::ExcMessage("Only what is bonded has a rest of it."));
    const pairing::BondLaw &law     = *points[i].node->bond;
    const double            opened  = start[i].opened;
    const double            slipped = start[i].slipped;
    const double            least   = points[i].node->least_opening();
    return law.is_brittle() ?
             law.rest(opened, slipped, least) :
             law.rest(std::max(opened, gap), slipped + slip, least);
  }

  /* T a (1 - w / l), of which less is left where an opening closes again. */
  double
  IncrementLaws::pull(const std::size_t i,
                      const double      slip,
                      const double      gap) const
  {
    const pairing::ContactNode &node = *points[i].node;
    return strength[i] * rest(i, slip, gap) *
           node.bond->unloading(gap, start[i].opened, node.least_opening());
  }

  double
  IncrementLaws::step_of(const std::size_t i) const
  {
    Assert(points[i].node->least_opening() > 0,
           dealii::ExcMessage("Ways have a size that is rounding."));
    return points[i].node->least_opening();
  }

  solvers::Bond
  IncrementLaws::bond(const Index  node,
                      const double slip,
                      const double gap) const
  {
    const auto i = static_cast<std::size_t>(node);
    AssertIndexRange(i, start.size());
    if (!bonds[i])
      return {-fluids[i], 0, 0};
    const double h = step_of(i), now = pull(i, slip, gap);
    return {now,
            (pull(i, slip + h, gap) - now) / h,
            (pull(i, slip, gap + h) - now) / h};
  }

  /* Methods that need a second-order cone take constant coefficients only: no
     bond, no ellipse whose aspect varies, and no mu of p or v. */
  bool
  IncrementLaws::has_cones() const
  {
    return !bonded && !elliptic &&
           std::all_of(constant.begin(), constant.end(), [](const auto &mu) {
             return mu[0] >= 0;
           });
  }

  double
  IncrementLaws::most_friction(const std::size_t  i,
                               const double       r_n,
                               const unsigned int axis) const
  {
    const pairing::ContactNode &node  = *points[i].node;
    const double                force = r_n - fluids[i];
    const double                known = constant[i][axis];
    double                      most  = 0;
    if (force > 0)
      most =
        force *
        (known >= 0 ?
           known :
           node.friction->largest_coefficient(situation(i, force, 0), axis));
    if (bonds[i])
      most += cohesion[i] * rest(i, 0, 0);
    if (!node.friction)
      return most;
    const double area = bonds[i] ? node.bonded_area() : node.covered_area();
    return std::clamp(node.friction->largest_force(start[i], area), 0., most);
  }

  /* What opens or slips in the increment holds no more than what has not. */
  solvers::Holding
  IncrementLaws::holding(const Eigen::VectorXd &r) const
  {
    constexpr double without_end = std::numeric_limits<double>::infinity();
    const auto       n           = static_cast<Index>(start.size());
    solvers::Holding most{Eigen::VectorXd::Zero(n),
                          Eigen::VectorXd::Zero(n),
                          Eigen::VectorXd::Zero(n)};
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const auto k = static_cast<Index>(i);
        if (!active[i])
          continue;
        most.push[k] = without_end;
        if (joined[i])
          {
            most.friction[k] = most.pull[k] = without_end;
            continue;
          }
        const double r_n = r[points[i].normal()];
        most.friction[k] = most_friction(i, r_n, 0);
        if (has_axes(i))
          most.friction[k] =
            std::max(most.friction[k], most_friction(i, r_n, 1));
        most.pull[k] = bonds[i] ?
                         pull(i, 0, std::max(start[i].gap, start[i].opened)) :
                         -fluids[i];
      }
    return most;
  }

  /* A bound of mu at any pressure and speed, by intervals: where even that
     holds no load the load has no equilibrium. */
  Eigen::VectorXd
  IncrementLaws::largest_coefficients() const
  {
    Eigen::VectorXd most =
      Eigen::VectorXd::Zero(static_cast<Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      for (const unsigned int axis : {0U, has_axes(i) ? 1U : 0U})
        {
          const double known = constant[i][axis];
          double      &mu    = most[static_cast<Index>(i)];
          mu                 = std::max(mu,
                        known >= 0 ?
                                          known :
                                          points[i].node->friction->largest_coefficient_of_all(
                            start[i], axis));
        }
    return most;
  }

  Eigen::VectorXd
  IncrementLaws::friction_at_start(const std::size_t i) const
  {
    AssertIndexRange(points[i].normal(), r_start.size());
    return r_start.segment(points[i].first,
                           points[i].normal() - points[i].first);
  }
} // namespace conetact::contact
