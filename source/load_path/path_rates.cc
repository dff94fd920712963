// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/path_rates.h"

#include "conetact/solvers/lcp.h"

#include <algorithm>
#include <utility>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
    using Eigen::VectorXi;

    constexpr int max_active_set_steps = 25;

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

    private:
      bool
      active_set(const Scheme &guess, const bool held, Rates &rates) const;
      bool
      corrected(const Rates &rates, Scheme &next) const;
      void
      correct(const Index  i,
              const Rates &rates,
              const double v_limit,
              const double r_limit,
              NodeScheme  &node) const;
      bool
      lemke(const Scheme &guess, Scheme &result) const;

      /** A gap or a slip whose rate is to be found, and its column among the
       * unknowns that may move. */
      struct Pair
      {
        std::size_t node;
        int         side; ///< 0: gap, else slip
        Index       column;
      };
      std::vector<Pair>
      close_and_stick(Scheme &scheme, std::vector<Index> &columns) const;
      struct Lcp
      {
        MatrixXd M;
        VectorXd q, cover;
        VectorXi rank;
      };
      Lcp
      superpose(const SchemeFactor       &base,
                const std::vector<Pair>  &pairs,
                const std::vector<Index> &columns) const;

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



    /** Closes and sticks all critical nodes of a scheme. */
    std::vector<RateProblem::Pair>
    RateProblem::close_and_stick(Scheme             &scheme,
                                 std::vector<Index> &columns) const
    {
      std::vector<Pair> pairs;
      for (std::size_t i = 0; i < scheme.size(); ++i)
        {
          const CriticalNode c = critical[i];
          if (c.normal)
            {
              scheme[i].closed = true;
              pairs.push_back({i, 0, static_cast<Index>(columns.size())});
              columns.push_back(system.normal[i]);
            }
          if (system.tangent[i] < 0 || !(c.plus || c.minus) ||
              system.is_free(static_cast<Index>(i), scheme[i].closed))
            continue;
          scheme[i].slip = 0;
          for (const int side : {1, -1})
            if (side > 0 ? c.plus : c.minus)
              pairs.push_back({i, side, static_cast<Index>(columns.size())});
          columns.push_back(system.tangent[i]);
        }
      return pairs;
    }



    /**
     * From all critical nodes closed and stuck: z are the rates of gaps and
     * slips that set in, x those of normal reactions and reserves, and
     * @f$x = M z + q@f$ by superposition.
     */
    RateProblem::Lcp
    RateProblem::superpose(const SchemeFactor       &base,
                           const std::vector<Pair>  &pairs,
                           const std::vector<Index> &columns) const
    {
      VectorXd v, r;
      MatrixXd V, R;
      base.rates(load_rate, v, r);
      base.responses(columns, V, R);
      const auto n = static_cast<Index>(pairs.size());
      Lcp        lcp{MatrixXd(n, n), VectorXd(n), VectorXd(n), VectorXi(n)};
      for (Index a = 0; a < n; ++a)
        {
          const Pair  &p  = pairs[static_cast<std::size_t>(a)];
          const Index  rn = system.normal[p.node], rt = system.tangent[p.node];
          const double mu        = system.mu(static_cast<Index>(p.node));
          Eigen::RowVectorXd row = R.row(rn);
          lcp.q(a)               = r(rn);
          if (p.side != 0)
            {
              // mu r_n + s r_t, the reserve
              row      = mu * row + p.side * R.row(rt);
              lcp.q(a) = mu * lcp.q(a) + p.side * r(rt);
            }
          for (Index b = 0; b < n; ++b)
            {
              const Pair &pb = pairs[static_cast<std::size_t>(b)];
              // a slip along -t moves its column backwards
              lcp.M(a, b) = row(pb.column) * (pb.side < 0 ? -1 : 1);
            }
          // The covering vector tightens all contacts by 1, with a cohesion of
          // 1: reserves grow by mu + 1, and by something without friction, too.
          lcp.cover(a) = p.side == 0 ? 1 : mu + 1;
          lcp.rank(a)  = p.side == 0 ? 0 : 1;
        }
      return lcp;
    }



    /**
     * The rate problem as a linear complementarity problem in the rates of all
     * critical gaps and slips; rigid motions are held softly.
     */
    bool
    RateProblem::lemke(const Scheme &guess, Scheme &result) const
    {
      result = guess;
      std::vector<Index>      columns;
      const std::vector<Pair> pairs = close_and_stick(result, columns);
      const SchemeFactor      base(system, result, true);
      if (!base.regular())
        return false;
      const Lcp lcp = superpose(base, pairs, columns);
      VectorXd  z;
      if (!solvers::solve_lcp(lcp.M, lcp.q, lcp.cover, lcp.rank, z))
        return false;
      for (std::size_t a = 0; a < pairs.size(); ++a)
        if (z(static_cast<Index>(a)) > 0)
          {
            if (pairs[a].side == 0)
              result[pairs[a].node].closed = false;
            else
              result[pairs[a].node].slip = pairs[a].side;
          }
      return true;
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
        (lemke(guess, start) && active_set(start, true, rates));
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
      // What the springs show of a motion that loads drive is its direction;
      // how fast it goes nothing determines.
      if (rates.factor.is_driven(load_rate, rates.v))
        {
          rates.outcome = RateOutcome::mechanism;
          rates.v       = rates.factor.motion(rates.v);
          rates.v /= solvers::largest(rates.v);
          rates.r.setZero();
        }
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
} // namespace conetact::load_path
