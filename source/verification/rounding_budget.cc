// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/verification/rounding_budget.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace conetact::verification
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    /** Thermal forces that cancel at a node leave less than this, over the
     * largest of them on the body. */
    constexpr double noise_of_thermal = 64 * epsilon;
  } // namespace



  RoundingBudget::RoundingBudget(const model::Bodies          &b,
                                 const contact::ElasticSystem &e,
                                 const contact::Coordinates   &p,
                                 const contact::ContactPoints &contacts,
                                 const double                  tol)
    : bodies(b)
    , elastic(e)
    , plain(p)
    , points(contacts)
    , tolerance(tol)
    , on_springs(bodies.structures.size(), 0.)
    , on_supports(on_springs)
  {}



  /* Forces in a body that springs carry along are known to the rounding of how
     far the ground has gone, now or in the past: what one increment leaves is
     where the next one starts. */
  VectorXd
  RoundingBudget::of_springs(const Finding &out) const
  {
    std::vector<double> ways = on_springs;
    for (const contact::Foundation &foundation : out.foundations)
      lengthen(ways, foundation.ground);
    return *std::max_element(ways.begin(), ways.end()) > 0 ? of_ways(ways) :
                                                             VectorXd();
  }



  VectorXd
  RoundingBudget::of_supports(const double t) const
  {
    std::vector<double> ways = on_supports;
    lengthen(ways, plain.prescribed(t));
    return of_ways(ways);
  }



  void
  RoundingBudget::lengthen(std::vector<double> &ways, const VectorXd &u) const
  {
    for (unsigned int body = 0; body < ways.size() && u.size() > 0; ++body)
      {
        const Index first = plain.offset(body), end = plain.offset(body + 1);
        for (Index dof = first; dof < end; ++dof)
          ways[body] = std::max(ways[body], std::abs(u[dof]));
      }
  }



  /* 16 eps sum_j |K_ij| s: the forces of displacements that are wrong by the
     rounding of a way s, the longest of the body, at all of its nodes and in
     the worst directions. */
  VectorXd
  RoundingBudget::of_ways(const std::vector<double> &ways) const
  {
    AssertDimension(ways.size(), bodies.structures.size());
    VectorXd way(plain.n_dofs());
    for (unsigned int body = 0; body < ways.size(); ++body)
      {
        const Index first = plain.offset(body);
        way.segment(first, plain.offset(body + 1) - first)
          .setConstant(ways[body]);
      }
    return 16 * epsilon * elastic.terms(way);
  }



  /* A rigid body has no elements: it takes what contacts and couplings hand on,
     at their arms. */
  std::pair<double, double>
  RoundingBudget::of_those_met(const unsigned int body,
                               const VectorXd    &rounding) const
  {
    std::set<unsigned int> met;
    double                 arm = 0;
    for (const contact::ContactPoint &point : points.all())
      {
        const pairing::ContactNode &node = *point.node;
        if (node.masters.empty() || (node.body != body && node.master != body))
          continue;
        met.insert(node.body == body ? node.master : node.body);
        arm = std::max(
          arm, node.position.distance(bodies.structures[body]->position(0)));
      }
    double force = 0;
    for (const unsigned int b : met)
      force +=
        rounding.segment(plain.offset(b), plain.offset(b + 1) - plain.offset(b))
          .sum();
    return {force, arm};
  }



  /* Returns the rounding of forces on a body on which nothing but rounding
     acts, and 0 for any other one: with loads of its own, or without any force.
     Supports and contacts that hold a body which strains itself by heat take up
     what its forces leave where they cancel. Either no force is larger than the
     rounding of the largest thermal one, or the forces do not balance and all
     of them together are less than the rounding of K w at all nodes, sum_i
     sum_j |K_ij| (8 eps |w_j| + 16 eps s), with the way s of of_ways(). */
  double
  RoundingBudget::of_body(const unsigned int body,
                          const Claim       &claim,
                          const Balance     &balance,
                          const VectorXd    &carried,
                          VectorXd          &rounding) const
  {
    AssertIndexRange(body, bodies.structures.size());
    AssertDimension(claim.loads->size(), plain.n_dofs());
    Assert(carried.size() == 0 || carried.size() == plain.n_dofs(),
           dealii::ExcMessage("Rounding at all dofs, or none."));
    const Index first = plain.offset(body);
    const Index n     = plain.offset(body + 1) - first;
    if (balance.forces + balance.largest_moment == 0 ||
        (claim.mechanical->segment(first, n).array() != 0).any())
      return 0;
    const auto is_turn = [&](const unsigned int b, const Index dof) {
      return (dof - plain.offset(b)) % bodies.structures[b]->n_components() >=
             bodies.dim;
    };
    double largest[2] = {0, 0}; // forces and moments have different units
    for (Index i = first; i < first + n; ++i)
      largest[is_turn(body, i)] =
        std::max(largest[is_turn(body, i)], std::abs((*claim.loads)[i]));
    if (balance.largest <= noise_of_thermal * largest[0] &&
        balance.largest_moment <= noise_of_thermal * largest[1])
      return noise_of_thermal * largest[0];
    // Forces that balance are forces, however small they are.
    if (balance.error() <= tolerance)
      return 0;
    if (rounding.size() == 0) // only where it may matter
      rounding = 8 * epsilon * elastic.terms(*claim.w) + of_supports(claim.t);
    double sum[2] = {0, 0};
    for (Index i = first; i < first + n; ++i)
      sum[is_turn(body, i)] += rounding[i];
    if (bodies.is_rigid(body))
      {
        const auto [force, arm] = of_those_met(body, rounding);
        sum[0] += force;
        sum[1] += force * arm;
      }
    // Contacts hand on what the springs of other bodies have.
    for (unsigned int b = 0; b < bodies.structures.size(); ++b)
      for (Index i = plain.offset(b);
           carried.size() > 0 && i < plain.offset(b + 1);
           ++i)
        sum[is_turn(b, i)] += carried[i];
    return balance.forces <= sum[0] && balance.largest_moment <= sum[1] ?
             sum[0] :
             0;
  }



  bool
  RoundingBudget::find(const Claim &claim, Finding &out) const
  {
    Assert(out.rounding.empty(), dealii::ExcMessage("It is found once."));
    AssertDimension(out.external.bodies.size(), bodies.structures.size());
    VectorXd rounding; // of all dofs
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      out.rounding.push_back(
        of_body(body, claim, out.external.bodies[body], out.carried, rounding));
    return *std::max_element(out.rounding.begin(), out.rounding.end()) > 0;
  }



  void
  RoundingBudget::forget(const contact::DofShare &share,
                         VectorXd                &rest,
                         Finding                 &out) const
  {
    AssertDimension(out.rounding.size(), bodies.structures.size());
    AssertDimension(rest.size(), share.size());
    const auto is_idle = [&](const unsigned int body) {
      return out.rounding[body] > 0;
    };
    for (unsigned int body = 0; body < out.rounding.size(); ++body)
      if (is_idle(body))
        {
          const Index first     = plain.offset(body);
          const Index n         = plain.offset(body + 1) - first;
          const auto [from, to] = share.within(first, first + n);
          rest.segment(from - share.begin(), to - from).setZero();
          for (contact::Foundation &foundation : out.foundations)
            if (foundation.forces.size() > 0)
              foundation.forces.segment(first, n).setZero();
        }
    // A reaction is nothing only if it is that to both of its sides.
    for (const contact::ContactPoint &point : points.all())
      if (is_idle(point.node->body) && !point.node->opening &&
          (point.node->masters.empty() || is_idle(point.node->master)))
        out.r.segment(point.first, static_cast<Index>(point.dual.size()))
          .setZero();
  }



  void
  RoundingBudget::accept(const double t, const Finding &finding)
  {
    for (const contact::Foundation &foundation : finding.foundations)
      lengthen(on_springs, foundation.ground);
    lengthen(on_supports, plain.prescribed(t));
  }



  void
  RoundingBudget::save(Archive &archive) const
  {
    archive.put("verification/springs", on_springs);
    archive.put("verification/supports", on_supports);
  }



  void
  RoundingBudget::restore(const Archive &archive)
  {
    archive.fill("verification/springs", on_springs);
    archive.fill("verification/supports", on_supports);
  }
} // namespace conetact::verification
