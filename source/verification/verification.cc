// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/verification/verification.h"

#include "conetact/base/text.h"
#include "conetact/contact/pieces.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::verification
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    constexpr double eps   = std::numeric_limits<double>::epsilon();
    constexpr double noise = 64 * eps; ///< of the largest force so far

    /** Ends a sentence about forces that do not balance: pieces that nothing
     * joins may be the reason. */
    std::string
    loose_pieces(const bodies::Structure &structure)
    {
      const unsigned int n = contact::n_pieces(structure);
      return n == 1 ? "" :
                      ". The body is in " + std::to_string(n) +
                        " pieces that are not joined: join them (their nodes "
                        "must be the same), or add a Support";
    }

  } // namespace



  Verification::Verification(const model::Bodies          &b,
                             const contact::ElasticSystem &e,
                             const contact::Coordinates   &p,
                             const contact::RigidMotions  &m,
                             const contact::ContactPoints &contacts,
                             const double                  tol)
    : bodies(b)
    , elastic(e)
    , plain(p)
    , motions(m)
    , points(contacts)
    , tolerance(tol)
    , budget(bodies, elastic, plain, points, tolerance)
    , law(bodies, elastic, points, tolerance)
    , largest_force(bodies.structures.size(), 0.)
  {}



  template <typename Points>
  VectorXd
  Verification::relative_displacements(const Points   &of,
                                       const VectorXd &u,
                                       const double    t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    // H u follows from the definition, node by node: the H of the solver is not
    // asked.
    VectorXd   v(points.n_all_unknowns());
    const auto at = [&](const unsigned int body, const unsigned int node) {
      Tensor<1, 3> displacement;
      for (unsigned int c = 0; c < bodies.dim; ++c)
        displacement[c] = u[plain.dof(body, node) + c];
      return displacement;
    };
    for (const contact::ContactPoint &point : of)
      {
        const pairing::ContactNode &node = *point.node;
        Tensor<1, 3>                d;
        pairing::for_each_side(node,
                               [&](const unsigned int body,
                                   const unsigned int i,
                                   const double       weight) {
                                 d += weight * at(body, i);
                               });
        d -= node.opponent_displacement(t);
        for (std::size_t k = 0; k < point.dual.size(); ++k)
          v[point.first + static_cast<Index>(k)] = d * point.dual[k];
      }
    return v;
  }



  /* F_b is the largest external force on a node of body b, loads of heat left
     out; at nodes they count as well. Each process looks at its own nodes, and
     the largest of all are taken together. */
  Scales
  Verification::scales(const Claim   &claim,
                       const Finding &out,
                       const Share   &share) const
  {
    // Three numbers of each body: the largest load, way and coordinate.
    const auto n_bodies = static_cast<Index>(bodies.structures.size());
    VectorXd   own      = VectorXd::Zero(3 * n_bodies);
    share.for_each_node(
      [&](const unsigned int body, const unsigned int i, const Index dof) {
        const auto raise = [&](const int kind, const double size) {
          double &largest = own[3 * static_cast<Index>(body) + kind];
          largest         = std::max(largest, size);
        };
        // Thermal forces cancel by themselves. They are a scale of equilibrium
        // at nodes, never of balance or law.
        raise(0, claim.loads->segment(dof, bodies.dim).norm());
        raise(1, out.u->segment(dof, bodies.dim).norm());
        raise(2, bodies.structures[body]->position(i).norm());
      });
    const VectorXd largest = share.largest(own);
    Scales         scales;
    scales.history  = largest_force;
    scales.rounding = out.rounding;
    for (Index body = 0; body < n_bodies; ++body)
      {
        const auto b = static_cast<std::size_t>(body);
        scales.force.push_back(out.external.bodies[b].largest);
        scales.nodal.push_back(
          std::max(scales.force.back(), largest[3 * body]));
        // Positions are known to the rounding of what they are sums of.
        scales.reach.push_back(largest[3 * body + 2] + largest[3 * body + 1]);
        scales.history[b] = std::max(scales.history[b], scales.nodal.back());
      }
    // Bodies are solved together: forces that are small beside those of others
    // have their noise.
    scales.noise =
      noise * *std::max_element(scales.history.begin(), scales.history.end());
    return scales;
  }



  /* |C^T (K w - f - H^T r)| <= tol F_b + 8 eps sum_j |K_ij| |w_j| at each
     unknown, and the rounding of the largest force so far. The sum of
     magnitudes costs a pass over all elements: it is made only where an error
     is not small by itself. */
  Verification::Unbalanced
  Verification::worst_node(const Claim  &claim,
                           const Scales &scales,
                           const Share  &share,
                           Finding      &out) const
  {
    AssertDimension(out.unbalanced.size(), share.size());
    AssertDimension(out.rounding.size(), bodies.structures.size());
    // C^T (K w - f - H^T r): what no support takes up, with the forces of
    // hanging nodes at their masters.
    const auto free = plain.restrict_rows(share.begin(), out.unbalanced);
    VectorXd   terms;
    Unbalanced first_wrong; // as bodies and nodes have their order
    const auto look_at = [&](const unsigned int body,
                             const Index        dof,
                             const bool         turns,
                             const Index        unknown) {
      // A moment becomes a force by the extent of the body.
      const double lever = turns ? 2 * motions.size(body) : 1.;
      const double error = std::abs(free[unknown]) / lever;
      const double scale = scales.nodal[body];
      // Without forces the scale is 0, and rounding over it infinite.
      if (error <= std::max(.1 * scales.noise, out.rounding[body]))
        return;
      // Far below the limit there is no need for |K| |w|.
      if (error <= .1 * tolerance * scale)
        {
          out.equilibrium = std::max(out.equilibrium, error / scale);
          return;
        }
      if (terms.size() == 0) // only where they may matter
        {
          const auto nodes = share.nodes();
          terms            = elastic.terms(*claim.w, &nodes);
        }
      // The rounding of K w is no fault of the solution. As w carries no rigid
      // motion this is no loophole: a body that floats away gains nothing by
      // it.
      double allowed = 8 * eps * terms[dof];
      if (out.carried.size() > 0)
        allowed += out.carried[dof];
      const double e  = relative(error - allowed / lever - scales.noise, scale);
      out.equilibrium = std::max(out.equilibrium, e);
      if (e > tolerance && first_wrong.error == 0)
        first_wrong = {e, body};
    };
    share.for_each_node(
      [&](const unsigned int body, const unsigned int, const Index dof) {
        for (unsigned int c = 0; c < bodies.structures[body]->n_components();
             ++c)
          plain.for_row(dof + c, [&](const Index unknown, double) {
            look_at(body, dof + c, c >= bodies.dim, unknown);
          });
      });
    return first_wrong;
  }



  /* Processes share nodes in their order, and the first that found an error
     tells: the sentence does not depend on their number. */
  void
  Verification::check_nodes(const Claim  &claim,
                            const Scales &scales,
                            const Share  &share,
                            Finding      &out) const
  {
    const Unbalanced own = worst_node(claim, scales, share, out);
    const auto       all = share.columns(Eigen::Vector3d(
      out.equilibrium, own.error, static_cast<double>(own.body)));
    out.equilibrium      = all.row(0).maxCoeff();
    for (const auto &found : all.colwise())
      if (found[1] > 0 && out.why.empty())
        {
          const auto body = static_cast<std::size_t>(found[2]);
          out.why         = "forces at a node of body '" + bodies.names[body] +
                    "' are out of balance by " + to_text(found[1]) +
                    " of the largest force on a node of it" +
                    loose_pieces(*bodies.structures[body]);
        }
  }



  void
  Verification::check_bodies(const Scales &scales, Finding &out) const
  {
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        // Errors that nodes may have can add up over a body, and rounding of K
        // can seem to carry what nothing holds: so each body is asked as a
        // whole.
        const Balance &balance = out.external.bodies[body];
        double         small   = scales.noise;
        if (out.carried.size() > 0)
          small += out.carried
                     .segment(plain.offset(body),
                              plain.offset(body + 1) - plain.offset(body))
                     .sum();
        const double size = motions.size(body);
        const double e =
          std::max(relative(balance.sum.force.norm() - small, balance.forces),
                   relative(balance.sum.moment.norm() - small * size,
                            balance.turning()));
        out.equilibrium = std::max(out.equilibrium, e);
        if (e > tolerance && out.why.empty())
          out.why = "the forces on " + bodies.called(body) +
                    " do not balance, by " + to_text(e) +
                    " of the sum of their magnitudes";
      }
  }



  /* The change H (u - u_last) less that of the obstacles, with the rows H that
     contacts have now, for the law, and with those that they had when the last
     increment ended, for the work that its reactions do. */
  void
  Verification::find_changes(const double t, Finding &out) const
  {
    AssertDimension(out.u->size(), plain.n_dofs());
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    out.displacements = relative_displacements(points.all(), *out.u, t);
    out.change        = out.displacements;
    if (last.u)
      // The same nodes and feet are asked, where they were.
      out.change -= relative_displacements(points.all(), *last.u, last.t);
    out.change_as_before = out.change;
    if (!last.points.empty())
      out.change_as_before =
        relative_displacements(last.points, *out.u, t) -
        relative_displacements(last.points, *last.u, last.t);
  }



  /* -H^T r from the definition, side by side: neither is the H^T of the solver
     asked. */
  void
  Verification::subtract_reactions(const VectorXd &r,
                                   const Share    &share,
                                   VectorXd       &forces) const
  {
    AssertDimension(r.size(), points.n_all_unknowns());
    AssertDimension(forces.size(), share.size());
    for (const contact::ContactPoint &point : points.all())
      {
        const Tensor<1, 3> force = contact::force_of(point, r);
        pairing::for_each_side(*point.node,
                               [&](const unsigned int body,
                                   const unsigned int node,
                                   const double       weight) {
                                 const Index dof = plain.dof(body, node);
                                 if (!share.has(dof))
                                   return;
                                 const Tensor<1, 3> f =
                                   bodies.in_frame(body, weight * force);
                                 for (unsigned int c = 0; c < bodies.dim; ++c)
                                   forces[dof - share.begin() + c] -= f[c];
                               });
      }
  }



  /* Where nothing moves as a whole u is w: one vector of all dofs less. */
  contact::SharedVector
  Verification::displacements(const Claim &claim) const
  {
    if (bodies.frames.empty() && claim.amounts.isZero(0))
      return claim.w;
    VectorXd u = motions.field(claim.amounts);
    u += *claim.w;
    return contact::shared(plain.displacements(std::move(u)));
  }



  /* K w - f - f_foundations - H^T r at the dofs of this process: what supports
     must add, and where nothing is held an error. */
  VectorXd
  Verification::find_rest(const Claim &claim,
                          const Share &share,
                          Finding     &out) const
  {
    // Gaps see all of u = R a + w, forces only w: K R = 0 is exact where nobody
    // computes it.
    VectorXd rest =
      share.of(elastic.structure_forces_at(share.nodes(), *claim.w));
    out.u             = displacements(claim);
    out.foundations   = elastic.foundations(*out.u, claim.t);
    out.strain_energy = .5 * share.sum(share.of(*claim.w).dot(rest));
    rest -= share.of(*claim.loads);
    for (const contact::Foundation &foundation : out.foundations)
      if (foundation.forces.size() > 0)
        rest -= share.of(foundation.forces);
    subtract_reactions(claim.r, share, rest);
    return rest;
  }



  void
  Verification::collect_forces(const Claim &claim,
                               const Share &share,
                               VectorXd    &rest,
                               Finding     &out) const
  {
    const auto in_space = [&](const VectorXd &f, VectorXd &room) -> auto &
    {
      if (bodies.frames.empty())
        return f;
      room = plain.forces_in_space(f);
      return std::as_const(room);
    };
    VectorXd   rest_in_space, loads_in_space;
    const auto collect = [&] {
      out.external =
        external_forces({bodies, plain, points, share},
                        in_space(rest, rest_in_space),
                        out.foundations,
                        in_space(*claim.mechanical, loads_in_space),
                        out.r);
    };
    collect();
    if (budget.find(claim, out))
      {
        // Sums, scales and reactions once more, without these bodies.
        budget.forget(share, rest, out);
        collect();
        for (std::size_t body = 0; body < out.rounding.size(); ++body)
          if (out.rounding[body] > 0)
            out.external.bodies[body] = Balance();
      }
    // Thermal forces are loads here: K w balances them as well, and the energy
    // of w contains their work.
    out.acting =
      share.of(in_space(*claim.loads, loads_in_space)) + out.external.held;
  }



  Finding
  Verification::judge(const Claim &claim) const
  {
    AssertDimension(claim.w->size(), plain.n_dofs());
    AssertDimension(claim.r.size(), points.n_all_unknowns());
    AssertDimension(claim.loads->size(), plain.n_dofs());
    AssertDimension(claim.mechanical->size(), plain.n_dofs());
    AssertDimension(claim.states.size(), points.size());
    Assert(!claim.laws ||
             claim.worn.size() == static_cast<Index>(points.size()),
           dealii::ExcMessage("What has laws knows the depths of its wear."));
    Finding out;
    if (!claim.amounts.allFinite() || !claim.w->allFinite() ||
        !claim.r.allFinite())
      {
        out.why      = "its displacements or forces are not finite";
        out.residual = out.equilibrium =
          std::numeric_limits<double>::infinity();
        return out;
      }
    const Share share(bodies, plain);
    VectorXd    rest = find_rest(claim, share, out);
    out.unbalanced   = rest;
    // Reactions of supports are read at the nodes that carry them; where some
    // follow others nothing is shared.
    if (!share.is_shared())
      plain.unhang(rest);
    out.r       = claim.r;
    out.carried = budget.of_springs(out);
    collect_forces(claim, share, rest, out);
    find_changes(claim.t, out);
    out.missed_by_bound = out.displacements.tail(points.n_bound_unknowns()) +
                          points.gaps_to_close();
    const Scales limits = scales(claim, out, share);
    out.largest_force   = limits.nodal;
    check_nodes(claim, limits, share, out);
    check_bodies(limits, out);
    law.check(claim, limits, out);
    return out;
  }



  void
  Verification::save(Archive &archive) const
  {
    archive.put("verification/u", contact::numbers(last.u));
    archive.put("verification/t", last.t);
    archive.put("verification/history", largest_force);
    budget.save(archive);
  }



  void
  Verification::restore(const Archive &archive)
  {
    VectorXd u = VectorXd::Zero(plain.n_dofs());
    archive.fill("verification/u", u);
    last.u = contact::shared(std::move(u));
    archive.fill("verification/t", last.t);
    archive.fill("verification/history", largest_force);
    budget.restore(archive);
    remember_contacts();
  }



  void
  Verification::remember_contacts()
  {
    if (!points.slide())
      return;
    last.nodes  = points.nodes();
    last.points = points.all();
    // Points refer to nodes by their address: to the copies now.
    for (contact::ContactPoint &point : last.points)
      point.node = last.nodes.data() + (point.node - points.nodes().data());
  }



  void
  Verification::accept(const double t, const Finding &finding)
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    Assert(finding.why.empty(),
           dealii::ExcMessage("Only what is right is accepted."));
    // The slip of the next increment starts here.
    last = {finding.u, t, {}, {}};
    remember_contacts();
    for (std::size_t body = 0; body < largest_force.size(); ++body)
      largest_force[body] =
        std::max(largest_force[body], finding.largest_force[body]);
    budget.accept(t, finding);
  }
} // namespace conetact::verification
