// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/rate_lcp.h"

#include "conetact/solvers/lcp.h"

namespace conetact::load_path
{
  using Eigen::Index;
  using Eigen::VectorXd;



  RateLcp::RateLcp(const PathSystem    &system,
                   const Scheme        &scheme,
                   const CriticalNodes &critical,
                   const Vector        &load_rate)
    : base(scheme)
  {
    eigen_assert(static_cast<Index>(scheme.size()) == system.n_nodes());
    eigen_assert(critical.size() == scheme.size());
    eigen_assert(load_rate.size() == system.size());
    const std::vector<Index> columns = close_and_stick(system, critical);
    const SchemeFactor       factor(system, base, true);
    regular = factor.regular();
    if (!regular)
      return;
    factor.rates(load_rate, v, r);
    factor.responses(columns, V, R);
    superpose(system);
  }



  /** Closes and sticks all critical nodes; the unknowns that may move. */
  std::vector<Index>
  RateLcp::close_and_stick(const PathSystem    &system,
                           const CriticalNodes &critical)
  {
    std::vector<Index> columns;
    for (std::size_t i = 0; i < base.size(); ++i)
      {
        const CriticalNode c = critical[i];
        if (c.normal)
          {
            base[i].closed = true;
            pairs.push_back({i, 0, static_cast<Index>(columns.size())});
            columns.push_back(system.normal[i]);
          }
        if (system.tangent[i] < 0 || !(c.plus || c.minus) ||
            system.is_free(static_cast<Index>(i), base[i].closed))
          continue;
        base[i].slip = 0;
        for (const int side : {1, -1})
          if (side > 0 ? c.plus : c.minus)
            pairs.push_back({i, side, static_cast<Index>(columns.size())});
        columns.push_back(system.tangent[i]);
      }
    return columns;
  }



  void
  RateLcp::superpose(const PathSystem &system)
  {
    const auto n = static_cast<Index>(pairs.size());
    M.resize(n, n);
    q.resize(n);
    cover.resize(n);
    rank.resize(n);
    for (Index a = 0; a < n; ++a)
      {
        const RatePair &p  = pairs[static_cast<std::size_t>(a)];
        const Index     rn = system.normal[p.node], rt = system.tangent[p.node];
        const double    mu     = system.mu(static_cast<Index>(p.node));
        Eigen::RowVectorXd row = R.row(rn);
        q(a)                   = r(rn);
        if (p.side != 0)
          {
            // mu r_n + s r_t, the reserve
            row  = mu * row + p.side * R.row(rt);
            q(a) = mu * q(a) + p.side * r(rt);
          }
        for (Index b = 0; b < n; ++b)
          {
            const RatePair &pb = pairs[static_cast<std::size_t>(b)];
            // a slip along -t moves its column backwards
            M(a, b) = row(pb.column) * (pb.side < 0 ? -1 : 1);
          }
        // The covering vector tightens all contacts by 1, with a cohesion of
        // 1: reserves grow by mu + 1, and by something without friction, too.
        cover(a) = p.side == 0 ? 1 : mu + 1;
        rank(a)  = p.side == 0 ? 0 : 1;
      }
  }



  bool
  RateLcp::solve(Vector &z, Scheme &result) const
  {
    if (!regular || !solvers::solve_lcp(M, q, cover, rank, z))
      return false;
    std::vector<bool> moves;
    for (Index a = 0; a < z.size(); ++a)
      moves.push_back(z(a) > 0);
    result = scheme(moves);
    return true;
  }



  Scheme
  RateLcp::scheme(const std::vector<bool> &moves) const
  {
    eigen_assert(moves.size() == pairs.size());
    Scheme result = base;
    for (std::size_t a = 0; a < pairs.size(); ++a)
      if (moves[a])
        {
          if (pairs[a].side == 0)
            result[pairs[a].node].closed = false;
          else
            result[pairs[a].node].slip = pairs[a].side;
        }
    return result;
  }



  VectorXd
  RateLcp::in_columns(const Vector &z) const
  {
    eigen_assert(z.size() == static_cast<Index>(pairs.size()));
    VectorXd result = VectorXd::Zero(V.cols());
    for (std::size_t a = 0; a < pairs.size(); ++a)
      result(pairs[a].column) +=
        (pairs[a].side < 0 ? -1 : 1) * z(static_cast<Index>(a));
    return result;
  }



  VectorXd
  RateLcp::displacements(const Vector &z, const double p) const
  {
    return V * in_columns(z) + p * v;
  }



  VectorXd
  RateLcp::reactions(const Vector &z, const double p) const
  {
    return R * in_columns(z) + p * r;
  }
} // namespace conetact::load_path
