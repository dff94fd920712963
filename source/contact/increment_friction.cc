// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/increment_friction.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    /** Of what an expression is differentiated by. */
    constexpr double difference = 1e-6;

    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  } // namespace

  IncrementFriction::IncrementFriction(
    const ContactPoints                &p,
    std::vector<pairing::FrictionPoint> known,
    const double                        duration)
    : points(p)
    , start(std::move(known))
    , time(duration)
    , constant(start.size(), not_known)
  {
    AssertDimension(start.size(), points.size());
    Assert(time > 0, dealii::ExcMessage("Increments take time."));
    for (std::size_t i = 0; i < start.size(); ++i)
      if (const auto &law = points[i].node->friction; !law)
        constant[i] = points[i].mu;
      else if (law->is_known())
        constant[i] = coefficient(i, 0, 0);
  }

  double
  IncrementFriction::coefficient(const std::size_t i,
                                 const double      p,
                                 const double      v) const
  {
    pairing::FrictionPoint here = start[i];
    here.pressure               = p;
    here.speed                  = v;
    return std::max(0., points[i].node->friction->coefficient(here));
  }

  template <typename Function>
  double
  IncrementFriction::slope(const Function &f, const double x)
  {
    const double h = difference * x;
    return h > 0 ? (f(x + h) - f(x - h)) / (2 * h) : 0.;
  }

  solvers::FrictionLimit
  IncrementFriction::at(const Eigen::Index node,
                        const double       r_n,
                        const double       slip) const
  {
    const auto i = static_cast<std::size_t>(node);
    AssertIndexRange(i, start.size());
    const double force = std::max(r_n, 0.);
    if (constant[i] >= 0)
      return {constant[i] * r_n, constant[i], 0};
    const pairing::ContactNode &own  = *points[i].node;
    const double                area = own.meets_nothing() ? 0 : own.area;
    const double p = area > 0 ? force / area : 0., v = slip / time;
    const double mu = coefficient(i, p, v);
    const double by_pressure =
      slope([&](const double x) { return coefficient(i, x, v); }, p);
    const double by_speed =
      slope([&](const double x) { return coefficient(i, p, x); }, v);
    const double most = own.friction->shear_limit(start[i]) * area;
    if (most <= 0)
      return {};
    if (mu * force > most)
      return {most, 0, 0};
    return {mu * force, mu + p * by_pressure, force * by_speed / time};
  }

  bool
  IncrementFriction::is_known() const
  {
    return std::all_of(constant.begin(), constant.end(), [](const double mu) {
      return mu >= 0;
    });
  }

  Eigen::VectorXd
  IncrementFriction::coefficients(const solvers::ContactState &state) const
  {
    Eigen::VectorXd mu(static_cast<Eigen::Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const ContactPoint &point = points[i];
        const double        r_n   = state.r[point.normal()];
        const double        slip =
          state.v.segment(point.first, point.normal() - point.first).norm();
        const auto k     = static_cast<Eigen::Index>(i);
        const auto limit = at(k, r_n, slip);
        mu[k]            = r_n > 0 ? limit.value / r_n : limit.by_force;
      }
    return mu;
  }

  bool
  has_varying_friction(const ContactPoints &points)
  {
    return std::any_of(points.begin(),
                       points.end(),
                       [](const ContactPoint &point) {
                         return point.node->friction != nullptr;
                       });
  }
} // namespace conetact::contact
