// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/path_events.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;
    using Hit = PathEvent::Hit;

    /** Events closer than this share of the way from the start are one. */
    constexpr double same_event = 1e-10;
    /** Events further off, in times of what a path took so far, never come. */
    constexpr double horizon = 1e7;
  } // namespace



  std::vector<PathState>
  path_states(const PathSystem &system, const Scheme &scheme)
  {
    eigen_assert(static_cast<Index>(scheme.size()) == system.n_nodes());
    std::vector<PathState> result;
    for (std::size_t i = 0; i < scheme.size(); ++i)
      {
        const NodeScheme s    = scheme[i];
        const auto       node = static_cast<Index>(i);
        const bool       free = system.is_free(node, s.closed);
        if (!s.closed)
          result.push_back(s.slip == 0 || free ? PathState::open :
                           s.slip > 0          ? PathState::open_plus :
                                                 PathState::open_minus);
        else if (free && system.tangent[i] >= 0)
          result.push_back(PathState::slip);
        else
          result.push_back(s.slip == 0 ? PathState::stick :
                           s.slip > 0  ? PathState::slip_plus :
                                         PathState::slip_minus);
      }
    return result;
  }



  RatioTest::RatioTest(std::shared_ptr<const PathSystem> of_system,
                       const PathLaw                     of_law)
    : shared(std::move(of_system))
    , system(*shared)
    , law(of_law)
  {}



  CriticalNodes
  RatioTest::critical_nodes(const PathPosition &now) const
  {
    eigen_assert(static_cast<Index>(now.scheme.size()) == system.n_nodes());
    // Scaled quantities compare from node to node: what vanishes does so beside
    // the largest.
    const double v_zero = value_tolerance * solvers::largest(now.v);
    const double r_zero =
      value_tolerance *
      std::max(solvers::largest(now.r), solvers::largest(now.load));
    const bool    holonomic = law == PathLaw::holonomic;
    CriticalNodes result(now.scheme.size());
    for (std::size_t i = 0; i < now.scheme.size(); ++i)
      {
        const auto       index = static_cast<Index>(i);
        const NodeScheme s     = now.scheme[i];
        const Index      n = system.normal[i], t = system.tangent[i];
        CriticalNode    &c = result[i];
        c.normal           = s.closed ? now.r(n) <= r_zero : now.v(n) <= v_zero;
        if (t < 0 || system.mu(index) + system.cohesion(index) == 0)
          continue;
        if (system.cohesion(index) == 0 && (c.normal || !s.closed))
          {
            // at the apex, where a total slip has a direction of its own
            const bool turned = holonomic && std::abs(now.slip(t)) > v_zero;
            c.plus = c.minus = c.normal && !turned;
            continue;
          }
        const double bound =
          system.mu(index) * now.r(n) + system.cohesion(index);
        if (s.slip != 0)
          {
            // Coulomb's law asks for the rate: a node that slips may stop at
            // any event. The holonomic law asks for the total slip: only back
            // at zero may it turn.
            const bool stops = !holonomic || s.slip * now.slip(t) <= v_zero;
            c.plus           = s.slip > 0 && stops;
            c.minus          = s.slip < 0 && stops;
          }
        else
          {
            // Reserves mu r_n + c +- r_t; one that is used up lets the node
            // slip.
            c.plus  = bound + now.r(t) <= r_zero;
            c.minus = bound - now.r(t) <= r_zero;
          }
      }
    return result;
  }



  /* A quantity that has just vanished is decided by the next rate problem, like
     those that had vanished before. */
  void
  RatioTest::mark(const PathEvent &event, PathPosition &now) const
  {
    eigen_assert(event.node >= 0 && event.node < system.n_nodes());
    const auto    i = static_cast<std::size_t>(event.node);
    CriticalNode &c = now.critical[i];
    const Index   t = system.tangent[i];
    if (event.hit == Hit::plus)
      c.plus = true;
    else if (event.hit == Hit::minus)
      c.minus = true;
    else
      {
        c.normal = true;
        if (t < 0 || system.cohesion(event.node) > 0 ||
            system.mu(event.node) == 0)
          return;
        const bool turned =
          law == PathLaw::holonomic &&
          std::abs(now.slip(t)) > value_tolerance * solvers::largest(now.v);
        c.plus = c.minus = !turned;
      }
  }



  PathEvents
  RatioTest::events(const PathPosition &now,
                    const VectorXd     &v_rate,
                    const VectorXd     &r_rate,
                    const double        noise) const
  {
    eigen_assert(v_rate.size() == r_rate.size());
    eigen_assert(noise >= 0);
    const double v_size  = solvers::largest(now.v),
                 v_fast  = solvers::largest(v_rate);
    const double r_size  = solvers::largest(now.r),
                 r_fast  = solvers::largest(r_rate);
    const bool holonomic = law == PathLaw::holonomic;

    PathEvents result;
    // Critical quantities have been decided: what falls there is round-off.
    const auto consider = [&](const Index  i,
                              const Hit    hit,
                              const double value,
                              const double rate,
                              const double size,
                              const double fast) {
      const CriticalNode &c       = now.critical[static_cast<std::size_t>(i)];
      const bool          decided = hit == Hit::normal ? c.normal :
                                    hit == Hit::plus   ? c.plus :
                                                         c.minus;
      if (!decided && rate < -noise * fast &&
          value * fast <= -rate * horizon * std::max(size, value))
        result.push_back(
          {std::max(0., value) / -rate, 1e-13 * size / -rate, i, hit});
    };
    for (std::size_t k = 0; k < now.scheme.size(); ++k)
      {
        const auto       i = static_cast<Index>(k);
        const NodeScheme s = now.scheme[k];
        const Index      n = system.normal[k], t = system.tangent[k];
        if (s.closed)
          consider(i, Hit::normal, now.r(n), r_rate(n), r_size, r_fast);
        else
          consider(i, Hit::normal, now.v(n), v_rate(n), v_size, v_fast);
        // Where r_t = 0 whatever happens there is no reserve to use up.
        if (t < 0 || system.is_free(i, s.closed))
          continue;
        const double mu    = system.mu(i),
                     bound = mu * now.r(n) + system.cohesion(i);
        for (const int side : {1, -1})
          {
            const Hit hit = side > 0 ? Hit::plus : Hit::minus;
            if (s.slip == 0)
              consider(i,
                       hit,
                       bound + side * now.r(t),
                       mu * r_rate(n) + side * r_rate(t),
                       r_size,
                       r_fast);
            else if (holonomic && s.slip == side)
              consider(
                i, hit, side * now.slip(t), side * v_rate(t), v_size, v_fast);
          }
      }
    return result;
  }



  PathEvents
  RatioTest::first(const PathEvents &all, const double from)
  {
    const auto earlier = [](const PathEvent &a, const PathEvent &b) {
      return a.step < b.step;
    };
    PathEvents result;
    if (all.empty())
      return result;
    const double step = std::min_element(all.begin(), all.end(), earlier)->step;
    for (const PathEvent &e : all)
      // Nodes that reach their corners together (symmetry) must be decided
      // together: one by one the first decision would contradict the next.
      if (e.step <= step + e.blur + same_event * (from + step))
        result.push_back(e);
    std::sort(result.begin(), result.end(), earlier);
    return result;
  }



  bool
  RatioTest::are_now(const PathEvents &first, const double from)
  {
    return !first.empty() &&
           first.front().step <= first.front().blur + same_event * from;
  }



  bool
  RatioTest::add(const PathEvents &first, PathPosition &now) const
  {
    bool added = false;
    for (const PathEvent &e : first)
      {
        const auto         i      = static_cast<std::size_t>(e.node);
        const CriticalNode before = now.critical[i];
        mark(e, now);
        added = added || before.normal != now.critical[i].normal ||
                before.plus != now.critical[i].plus ||
                before.minus != now.critical[i].minus;
      }
    return added;
  }



  void
  RatioTest::turn_closing_nodes(const PathPosition &now, Scheme &scheme) const
  {
    if (law == PathLaw::incremental)
      return;
    for (std::size_t i = 0; i < scheme.size(); ++i)
      if (const Index t = system.tangent[i];
          t >= 0 && now.critical[i].normal && !scheme[i].closed &&
          system.is_free(static_cast<Index>(i), false))
        scheme[i].slip = now.critical[i].plus ? 0 : now.slip(t) > 0 ? 1 : -1;
  }
} // namespace conetact::load_path
