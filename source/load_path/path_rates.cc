// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/path_rates.h"

#include "conetact/load_path/leave_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    constexpr int max_active_set_steps = 25;

    /**
     * What soft springs show of a motion that loads drive is its direction; how
     * fast it goes nothing determines.
     */
    void
    show_motion(Rates &rates, const VectorXd &load_rate)
    {
      if (!rates.factor.is_driven(load_rate, rates.v))
        return;
      rates.outcome = RateOutcome::mechanism;
      rates.v       = rates.factor.motion(rates.v);
      rates.v /= solvers::largest(rates.v);
      rates.r.setZero();
    }

    /** One rate problem, with everything it needs. */
    class RateProblem
    {
    public:
      RateProblem(const PathSystem    &s,
                  const CriticalNodes &c,
                  const VectorXd      &f)
        : system(s)
        , critical(c)
        , load_rate(f)
      {}

      Rates
      solve(const Scheme &guess) const;
      Rates
      pass(const Arrival &arrival) const;

    private:
      bool
      active_set(const Scheme &guess, const bool held, Rates &rates) const;
      bool
      corrected(const Rates &rates, Scheme &next) const;
      /** Whether a node that slips comes to rest on the motion that soft
       * springs show; the scheme in which it does. */
      bool
      stops(const Rates &rates, Scheme &stopped) const;
      void
      correct(const Index  i,
              const Rates &rates,
              const double v_limit,
              const double r_limit,
              NodeScheme  &node) const;
      bool
      lemke(const Scheme &guess, Scheme &result) const;
      Scheme
      opened(Scheme scheme) const;

      std::vector<bool>
      incoming(const RateLcp &lcp, const Arrival &arrival) const;
      bool
      rates_along(const Ray &ray, const RateLcp &lcp, Rates &rates) const;
      bool
      stands_still(const Ray &ray, const RateLcp &lcp, Rates &rates) const;

      const PathSystem    &system;
      const CriticalNodes &critical;
      const VectorXd      &load_rate;
    };



    /* The rate of what is critical has a sign that its state does not allow: a
       closed node would pull, an open one penetrate, a slip go backwards, a
       stuck one take more than friction gives. */
    void
    RateProblem::correct(const Index  i,
                         const Rates &rates,
                         const double v_limit,
                         const double r_limit,
                         NodeScheme  &s) const
    {
      const auto         node = static_cast<std::size_t>(i);
      const CriticalNode c    = critical[node];
      const Index        n = system.normal[node], t = system.tangent[node];
      const double       r_n = rates.r(n);
      if (c.normal && s.closed && r_n < -r_limit)
        s.closed = false;
      else if (c.normal && !s.closed && rates.v(n) < -v_limit)
        {
          s.closed = true;
          // At the apex both ways are open: stick is tried first.
          if (c.plus && c.minus)
            s.slip = 0;
        }
      else if (t >= 0 && !system.is_free(i, s.closed))
        {
          const double bound = system.mu(i) * r_n, r_t = rates.r(t);
          if (s.slip != 0)
            {
              if ((s.slip > 0 ? c.plus : c.minus) &&
                  s.slip * rates.v(t) < -v_limit)
                s.slip = 0;
            }
          else if (c.plus && bound + r_t < -r_limit)
            s.slip = 1;
          else if (c.minus && bound - r_t < -r_limit)
            s.slip = -1;
        }
    }



    /** The scheme with all violations turned over; false: there are none. */
    bool
    RateProblem::corrected(const Rates &rates, Scheme &next) const
    {
      const double v_limit = rate_tolerance * solvers::largest(rates.v);
      const double r_limit =
        rate_tolerance *
        std::max(solvers::largest(rates.r), solvers::largest(load_rate));
      next = rates.scheme;
      for (std::size_t i = 0; i < next.size(); ++i)
        if (critical[i].any())
          correct(static_cast<Index>(i), rates, v_limit, r_limit, next[i]);
      return !(next == rates.scheme);
    }



    bool
    RateProblem::active_set(const Scheme &guess,
                            const bool    held,
                            Rates        &rates) const
    {
      std::vector<Scheme> visited;
      Scheme              next = guess;
      for (int k = 0; k < max_active_set_steps; ++k)
        {
          // A scheme seen before comes again for ever.
          if (std::find(visited.begin(), visited.end(), next) != visited.end())
            return false;
          visited.push_back(next);
          rates.scheme = next;
          rates.factor = SchemeFactor(system, next, held);
          if (!rates.factor.regular())
            return false;
          rates.factor.rates(load_rate, rates.v, rates.r);
          if (!corrected(rates, next))
            return true;
        }
      return false;
    }



    /**
     * The rate problem as a linear complementarity problem in the rates of all
     * critical gaps and slips; rigid motions are held softly.
     */
    bool
    RateProblem::lemke(const Scheme &guess, Scheme &result) const
    {
      const RateLcp lcp(system, guess, critical, load_rate);
      VectorXd      z;
      return lcp.solve(z, result);
    }



    /** All nodes open that may open; what slips keeps its side. */
    Scheme
    RateProblem::opened(Scheme scheme) const
    {
      for (std::size_t i = 0; i < scheme.size(); ++i)
        if (critical[i].normal)
          scheme[i].closed = false;
      return scheme;
    }



    Rates
    RateProblem::solve(const Scheme &guess) const
    {
      Rates rates;
      rates.outcome = RateOutcome::found;
      if (active_set(guess, false, rates))
        return rates;

      Scheme     start;
      const bool found =
        active_set(guess, true, rates) ||
        (lemke(guess, start) && active_set(start, true, rates)) ||
        // A motion at constant load ends in a scheme that is singular, from
        // which nothing follows.
        active_set(opened(guess), true, rates);
      if (!found)
        {
          rates.outcome = RateOutcome::none;
          return rates;
        }
      if (system.null_space.cols() == 0)
        return rates;
      Rates exact;
      exact.outcome = RateOutcome::found;
      // The soft springs on rigid motions were needed on the way only.
      if (active_set(rates.scheme, false, exact))
        return exact;
      Scheme stopped;
      if (!stops(rates, stopped))
        show_motion(rates, load_rate);
      else if (active_set(stopped, false, exact))
        return exact;
      else
        rates.outcome = RateOutcome::none;
      return rates;
    }



    /* Forces do not change on the way: the node that turns first is where rates
       come down to zero first. */
    bool
    RateProblem::stops(const Rates &rates, Scheme &stopped) const
    {
      stopped = rates.scheme;
      if (!rates.factor.is_driven(load_rate, rates.v))
        return false;
      const VectorXd motion  = rates.factor.motion(rates.v);
      const double   least   = rate_tolerance * solvers::largest(motion);
      NodeScheme    *first   = nullptr;
      double         soonest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < stopped.size(); ++i)
        {
          NodeScheme        &s = stopped[i];
          const CriticalNode c = critical[i];
          const Index        t = system.tangent[i];
          const bool may_stop  = s.slip > 0 ? c.plus : s.slip < 0 && c.minus;
          if (t < 0 || !may_stop || !(s.slip * motion(t) < -least))
            continue;
          const double when = -rates.v(t) / motion(t);
          if (when < soonest)
            {
              soonest = when;
              first   = &s;
            }
        }
      if (first != nullptr)
        first->slip = 0;
      return first != nullptr;
    }



    /** Which pairs move on the piece that comes in. */
    std::vector<bool>
    RateProblem::incoming(const RateLcp &lcp, const Arrival &arrival) const
    {
      std::vector<bool> moves;
      for (const RatePair &pair : lcp.pairs)
        {
          const NodeScheme s = arrival.scheme[pair.node];
          const auto       i = static_cast<Index>(pair.node);
          // Into the apex an open node comes from the side it moves away from.
          const bool free = pair.side != 0 && system.is_free(i, s.closed);
          const int  slip = !free ? s.slip :
                            arrival.velocity(system.tangent[pair.node]) < 0 ? 1 :
                                                                              -1;
          moves.push_back(pair.side == 0 ? !s.closed : slip == pair.side);
        }
      return moves;
    }



    /** Rates of the scheme that a ray shows; false: it is no solution. */
    bool
    RateProblem::rates_along(const Ray     &ray,
                             const RateLcp &lcp,
                             Rates         &rates) const
    {
      rates.outcome = RateOutcome::found;
      rates.scheme  = lcp.scheme(ray.moves);
      rates.way     = ray.p < 0 ? -1 : 1;
      rates.factor  = SchemeFactor(system, rates.scheme, false);
      if (!rates.factor.regular())
        rates.factor = SchemeFactor(system, rates.scheme, true);
      if (!rates.factor.regular())
        return stands_still(ray, lcp, rates);
      const VectorXd along = rates.way * load_rate;
      rates.factor.rates(along, rates.v, rates.r);
      Scheme next;
      if (corrected(rates, next))
        return false;
      show_motion(rates, along);
      if (rates.outcome == RateOutcome::mechanism)
        rates.way = 1; // of no meaning
      return true;
    }



    /** A finite motion under loads that stay, against falling friction. */
    bool
    RateProblem::stands_still(const Ray     &ray,
                              const RateLcp &lcp,
                              Rates         &rates) const
    {
      const VectorXd v = lcp.displacements(ray.z(), ray.p);
      if (std::abs(ray.p) * solvers::largest(load_rate) >
          1e-9 * solvers::largest(v))
        return false;
      rates.outcome = RateOutcome::mechanism;
      rates.way     = 1; // of no meaning
      rates.v       = v / solvers::largest(v);
      rates.r       = lcp.reactions(ray.z(), ray.p) / solvers::largest(v);
      return true;
    }



    Rates
    RateProblem::pass(const Arrival &arrival) const
    {
      Rates         rates;
      const RateLcp lcp(system, arrival.scheme, critical, load_rate);
      if (!lcp.regular || lcp.pairs.empty())
        return rates;
      Ray          in = line_of(lcp.M, lcp.q, incoming(lcp, arrival));
      const double forward =
        arrival.way != 0 ?
          arrival.way * in.p :
          lcp.displacements(in.z(), in.p).dot(arrival.velocity);
      if (forward < 0)
        {
          in.value = -in.value;
          in.p     = -in.p;
        }
      // What is alike turns together, if it can; else one after the other.
      for (const double unequal : {0., .37, .73})
        {
          VectorXd weight = lcp.cover;
          for (Index a = 0; a < weight.size(); ++a)
            weight(a) *=
              1 + std::fmod(unequal * static_cast<double>(a + 1), 1.);
          Ray out = in;
          if (leave_vertex(lcp.M, lcp.q, weight, out) &&
              rates_along(out, lcp, rates))
            return rates;
        }
      rates.outcome = RateOutcome::none;
      return rates;
    }
  } // namespace



  Rates
  solve_rate_problem(const PathSystem      &system,
                     const Scheme          &scheme,
                     const CriticalNodes   &critical,
                     const Eigen::VectorXd &load_rate)
  {
    return RateProblem(system, critical, load_rate).solve(scheme);
  }



  Rates
  pass_vertex(const PathSystem      &system,
              const Arrival         &arrival,
              const CriticalNodes   &critical,
              const Eigen::VectorXd &load_rate)
  {
    return RateProblem(system, critical, load_rate).pass(arrival);
  }
} // namespace conetact::load_path
