// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/increment_laws.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

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

    [[noreturn]] void
    refuse_falling_closing(const pairing::ContactNode &node, const double p)
    {
      throw InputError(
        "A contact at " + to_text(node.position) +
        " closes less under more pressure, at p = " + to_text(p) +
        ": its closing is Compliance (or wear) times p. Let "
        "Compliance fall more slowly than 1/p.");
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

  IncrementLaws::IncrementLaws(const ContactPoints   &p,
                               std::vector<Situation> known,
                               const Eigen::VectorXd &r,
                               const double           duration)
    : points(p)
    , start(std::move(known))
    , r_start(r)
    , time(duration)
    , constant(start.size(), not_known)
    , active(start.size(), true)
    , soft(false)
  {
    AssertDimension(start.size(), points.size());
    Assert(time > 0, dealii::ExcMessage("Increments take time."));
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const pairing::ContactNode &node = *points[i].node;
        if (!node.friction)
          constant[i] = points[i].mu;
        else if (node.friction->is_known())
          constant[i] = coefficient(i, start[i]);
        active[i] = !node.active || (*node.active)(Point<3>(), start[i].t) != 0;
        soft      = soft || !active[i] || (node.layer && node.layer->is_soft());
      }
  }

  double
  IncrementLaws::area(const std::size_t i) const
  {
    const pairing::ContactNode &node = *points[i].node;
    return node.meets_nothing() ? 0. : node.area;
  }

  Situation
  IncrementLaws::situation(const std::size_t i,
                           const double      r_n,
                           const double      slip) const
  {
    Situation here = start[i];
    if (const double a = area(i); a > 0)
      here.pressure = std::max(r_n, 0.) / a;
    here.speed = slip / time;
    return here;
  }

  /** mu; what is below 0 is none. */
  double
  IncrementLaws::coefficient(const std::size_t i, const Situation &at) const
  {
    return std::max(0., points[i].node->friction->coefficient(at));
  }

  solvers::FrictionLimit
  IncrementLaws::limit(const Index  node,
                       const double r_n,
                       const double slip) const
  {
    const auto i = static_cast<std::size_t>(node);
    AssertIndexRange(i, start.size());
    if (constant[i] >= 0)
      return {constant[i] * r_n, constant[i], 0};
    const auto mu = [&](const Situation &at) { return coefficient(i, at); };
    const Situation here = situation(i, r_n, slip);
    const double    now = mu(here), force = std::max(r_n, 0.);
    // of what slips hardly: some part of a cell in the increment
    const double little = 1e-6 * points[i].node->spacing / time;
    const double most = points[i].node->friction->largest_force(here, area(i));
    if (most <= 0)
      return {};
    if (now * force > most)
      return {most, 0, 0};
    return {now * force,
            now + here.pressure * slope(mu, here, &Situation::pressure, 0),
            force * slope(mu, here, &Situation::speed, little) / time};
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
    const double        a     = area(i);
    if (!active[i])
      return out_of_sight(*point.node);
    if (!point.node->layer || !point.node->layer->is_soft() || a == 0)
      return {};
    const pairing::LayerLaw &law  = *point.node->layer;
    const Situation          here = situation(i, r_n, slip);
    const bool               now  = law.wears_at_once();
    const auto               C    = [&](const Situation &at) {
      return law.closing_by_pressure(at) +
             (now ? slip * law.wear_by_pressure(at) : 0.);
    };
    const double   p = here.pressure;
    solvers::Layer result;
    result.closing = C(here) * p;
    result.by_force =
      (C(here) + p * slope(C, here, &Situation::pressure, 0)) / a;
    if (result.by_force < 0)
      refuse_falling_closing(*point.node, p);
    if (now)
      result.by_slip = p * (law.wear_by_pressure(here) +
                            slope(C, here, &Situation::speed, 0) / time);
    result.shear = law.shear(here) / a;
    if (result.shear > 0)
      result.sheared = result.shear * friction_at_start(i);
    return result;
  }

  bool
  IncrementLaws::has_cones() const
  {
    return std::all_of(constant.begin(), constant.end(), [](const double mu) {
      return mu >= 0;
    });
  }

  Eigen::VectorXd
  IncrementLaws::friction_at_start(const std::size_t i) const
  {
    return r_start.segment(points[i].first,
                           points[i].normal() - points[i].first);
  }

  double
  IncrementLaws::slip(const std::size_t            i,
                      const solvers::ContactState &end) const
  {
    const ContactPoint &point = points[i];
    const Index         nt    = point.normal() - point.first;
    return solvers::see(
             [&](const double r_n, const double slip) {
               return layer(static_cast<Index>(i), r_n, slip);
             },
             end.v.segment(point.first, nt + 1),
             end.r.segment(point.first, nt + 1))
      .head(nt)
      .norm();
  }

  Eigen::VectorXd
  IncrementLaws::coefficients(const solvers::ContactState &end) const
  {
    Eigen::VectorXd mu(static_cast<Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const auto   k   = static_cast<Index>(i);
        const double r_n = end.r[points[i].normal()];
        const auto   now = limit(k, r_n, slip(i, end));
        mu[k]            = r_n > 0 ? now.value / r_n : now.by_force;
      }
    return mu;
  }

  Eigen::VectorXd
  IncrementLaws::slips(const solvers::ContactState &end) const
  {
    Eigen::VectorXd way =
      Eigen::VectorXd::Zero(static_cast<Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      if (end.node[i] == solvers::NodeState::slip)
        way[static_cast<Index>(i)] = slip(i, end);
    return way;
  }

  Eigen::VectorXd
  IncrementLaws::wear(const solvers::ContactState &end) const
  {
    Eigen::VectorXd depth = slips(end);
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const auto      k   = static_cast<Index>(i);
        const auto      law = points[i].node->layer;
        const Situation here =
          situation(i, end.r[points[i].normal()], depth[k]);
        depth[k] *= law ? here.pressure * law->wear_by_pressure(here) : 0.;
      }
    return depth;
  }

  bool
  has_nodal_laws(const ContactPoints &points)
  {
    return std::any_of(points.begin(),
                       points.end(),
                       [](const ContactPoint &point) {
                         return point.node->friction || point.node->layer ||
                                point.node->active;
                       });
  }
} // namespace conetact::contact
