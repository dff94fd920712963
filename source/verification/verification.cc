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

    /** The end of a sentence. */
    std::string
    loose_pieces(const bodies::Structure &structure)
    {
      const unsigned int n = contact::n_pieces(structure);
      return n == 1 ? "" :
                      ". The body is in " + std::to_string(n) +
                        " pieces that are not joined: join them (their nodes "
                        "must be the same), or add a Support";
    }

    /** An error over its scale; where nothing acts, none is allowed, and what
     * is not a number never is. */
    double
    relative(const double error, const double scale)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      if (error <= 0)
        return 0;
      return scale > 0 && error < infinity ? error / scale : infinity;
    }

    std::string
    place(const contact::Bodies &bodies, const contact::ContactPoint &point)
    {
      return "the contact node at " + to_text(point.node->position) +
             " of body '" + bodies.names[point.node->body] + "' ";
    }
  } // namespace

  /** What errors of this increment are compared with. */
  struct Verification::Scales
  {
    std::vector<double> nodal;     ///< F_b with thermal forces
    std::vector<double> force;     ///< F_b
    std::vector<double> history;   ///< largest F_b so far
    double              noise = 0; ///< rounding of the largest force so far
    std::vector<double> rounding;  ///< of bodies on which nothing acts
    std::vector<double> reach;     ///< largest coordinate + displacement
  };

  Verification::Verification(const contact::Bodies        &b,
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
    , past(bodies.structures.size())
    , stiffness(VectorXd::Zero(static_cast<Index>(points.size())))
  {}

  template <typename Points>
  VectorXd
  Verification::relative_displacements(const Points   &of,
                                       const VectorXd &u,
                                       const double    t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    // v = H u from the definition, node by node: the H of the solver is not
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

  /* What springs carry along is where it is to the rounding of how far that
     is, or was: what one increment leaves is the start of the next. What
     strains it is known to no less. Of what is prescribed only: a body that
     floats away gains nothing by it. */
  VectorXd
  Verification::rounding_of_springs(const Finding &out) const
  {
    std::vector<double> ways = past.on_springs;
    for (const contact::Foundation &foundation : out.foundations)
      lengthen(ways, foundation.ground);
    return *std::max_element(ways.begin(), ways.end()) > 0 ?
             rounding_of_ways(ways) :
             VectorXd();
  }

  /* What supports carry along is strained by the rounding of how far that is,
     or was. Of what is prescribed only, as above. */
  VectorXd
  Verification::rounding_of_supports(const double t) const
  {
    std::vector<double> ways = past.on_supports;
    lengthen(ways, plain.prescribed(t));
    return rounding_of_ways(ways);
  }

  void
  Verification::lengthen(std::vector<double> &ways, const VectorXd &u) const
  {
    for (unsigned int body = 0; body < ways.size() && u.size() > 0; ++body)
      {
        const Index first = plain.offset(body);
        ways[body] =
          std::max(ways[body],
                   solvers::largest(
                     u.segment(first, plain.offset(body + 1) - first)));
      }
  }

  /* All of a body goes as far as what goes furthest. */
  VectorXd
  Verification::rounding_of_ways(const std::vector<double> &ways) const
  {
    VectorXd way(plain.n_dofs());
    for (unsigned int body = 0; body < ways.size(); ++body)
      {
        const Index first = plain.offset(body);
        way.segment(first, plain.offset(body + 1) - first)
          .setConstant(ways[body]);
      }
    return 16 * eps * elastic.terms(way);
  }

  Verification::Scales
  Verification::scales(const Claim &claim, const Finding &out) const
  {
    Scales scales;
    scales.history  = past.force;
    scales.rounding = out.rounding;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        const bodies::Structure &structure    = *bodies.structures[body];
        const unsigned int       n_c          = structure.n_components();
        Index                    dof          = plain.offset(body);
        double                   largest_load = 0, coordinate = 0, moved = 0;
        for (unsigned int i = 0; i < structure.n_nodes(); ++i, dof += n_c)
          {
            const auto size = [&](const VectorXd &f) {
              return f.segment(dof, bodies.dim).norm();
            };
            // Thermal forces cancel by themselves. They are a scale of
            // equilibrium at nodes, never of balance or law.
            largest_load = std::max(largest_load, size(claim.loads));
            moved        = std::max(moved, size(out.u));
            coordinate   = std::max(coordinate, structure.position(i).norm());
          }
        scales.force.push_back(out.external.bodies[body].largest);
        scales.nodal.push_back(std::max(scales.force.back(), largest_load));
        // Positions are known to the rounding of what they are sums of.
        scales.reach.push_back(coordinate + moved);
        scales.history[body] =
          std::max(scales.history[body], scales.nodal.back());
      }
    // bodies are solved together: what is small beside others has their noise
    scales.noise =
      noise * *std::max_element(scales.history.begin(), scales.history.end());
    return scales;
  }

  void
  Verification::check_nodes(const Claim  &claim,
                            const Scales &scales,
                            Finding      &out) const
  {
    // C^T (K w - f - H^T r): what no support takes up, with the forces of
    // hanging nodes at their masters.
    VectorXd free = plain.restrict(out.unbalanced), terms;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        const unsigned int n_c = bodies.structures[body]->n_components();
        for (Index dof = plain.offset(body); dof < plain.offset(body + 1);
             ++dof)
          {
            const bool turns = (dof - plain.offset(body)) % n_c >= bodies.dim;
            plain.for_row(dof, [&](const Index unknown, double) {
              // A moment becomes a force by the extent of the body.
              const double error =
                std::abs(free[unknown]) / (turns ? 2 * motions.size(body) : 1.);
              const double scale = scales.nodal[body];
              if (error <= std::max(.1 * scales.noise, out.rounding[body]))
                return;
              // Far below the limit there is no need for |K| |w|.
              if (error <= .1 * tolerance * scale)
                {
                  out.equilibrium = std::max(out.equilibrium, error / scale);
                  return;
                }
              if (terms.size() == 0) // only where they may matter
                terms = elastic.terms(claim.w);
              // The rounding of K w is no fault of the solution. As w carries
              // no rigid motion this is no loophole: a body that floats away
              // gains nothing by it.
              double left = error - 8 * eps * terms[dof] - scales.noise;
              if (out.carried.size() > 0)
                left -= out.carried[dof];
              const double e  = relative(left, scale);
              out.equilibrium = std::max(out.equilibrium, e);
              if (e > tolerance && out.why.empty())
                out.why = "forces at a node of body '" + bodies.names[body] +
                          "' are out of balance by " + to_text(e) +
                          " of the largest force on a node of it" +
                          loose_pieces(*bodies.structures[body]);
            });
          }
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

  /** How a contact node breaks the law; all errors become forces over F. */
  struct Verification::LawErrors
  {
    double F;        ///< largest force on a node of its bodies
    double past;     ///< rounding of the forces so far
    double position; ///< rounding of positions [length]
    double k;        ///< what turns a length into the force that closes it

    double      worst = 0;
    const char *what  = "";

    void
    take(const double e, const char *name)
    {
      if (e > worst)
        what = name;
      worst = std::max(worst, e);
    }
    void
    force(const double error, const char *name)
    {
      take(relative(error - past, F), name);
    }
    void
    length(const double error, const char *name)
    {
      if (!(error <= position))
        take(k > 0 ? relative((error - position) * k - past, F) :
                     std::numeric_limits<double>::infinity(),
             name);
    }
  };

  Verification::LawErrors
  Verification::errors_of(const pairing::ContactNode &node,
                          const double                k,
                          const Scales               &scales) const
  {
    const unsigned int other = node.masters.empty() ? node.body : node.master;
    return {// A light body on a heavily loaded one is judged by its own forces.
            std::min(scales.force[node.body], scales.force[other]),
            std::max({scales.noise,
                      scales.rounding[node.body],
                      scales.rounding[other]}),
            // v is a difference of positions.
            16 * eps * std::max(scales.reach[node.body], scales.reach[other]),
            k};
  }

  /* Any reaction will do: only places are judged. */
  Verification::LawErrors
  Verification::bound_errors(const contact::ContactPoint &point,
                             const Scales                &scales,
                             const Finding               &out) const
  {
    const Index  first  = point.first - points.n_unknowns();
    const auto   n      = static_cast<Index>(point.dual.size());
    const double k      = bound_stiffness.size() > 0 ?
                            bound_stiffness.segment(first, n).minCoeff() :
                            0.;
    LawErrors    errors = errors_of(*point.node, k, scales);
    errors.length(
      out.missed_by_bound.segment(first, n).norm(),
      point.node->kind == pairing::ContactKind::tie ?
        "is tied and moves against what it is tied to (supports or a "
        "Gap may contradict the tie)" :
        "is bound and leaves what it is bound to (supports or a "
        "Gap may contradict that)");
    return errors;
  }

  Verification::LawErrors
  Verification::law_errors(const std::size_t i,
                           const Claim      &claim,
                           const Scales     &scales,
                           const Finding    &out) const
  {
    const contact::ContactPoint &point = points[i];
    const pairing::ContactNode  &node  = *point.node;
    LawErrors                    errors =
      errors_of(node, stiffness[static_cast<Index>(i)], scales);

    const auto     nt   = static_cast<Index>(point.dual.size()) - 1;
    const Index    n    = point.first + nt;
    const double   r_n  = claim.r[n];
    const double   gap  = node.gap + out.displacements[n];
    const VectorXd r_t  = claim.r.segment(point.first, nt);
    const VectorXd slip = (claim.incremental ? out.change : out.displacements)
                            .segment(point.first, nt);
    // Radius of the cone; cohesion holds at open nodes, too.
    const double limit = point.mu * r_n + node.cohesion;

    errors.force(-r_n, "is pulled by its contact");
    errors.force(r_t.norm() - std::max(limit, 0.),
                 "carries more than friction");
    if (claim.states[i] == solvers::NodeState::open)
      {
        // The zeros of open nodes are exact: all of what exceeds rounding
        // counts.
        errors.force(std::abs(r_n) > errors.past ? std::abs(r_n) + errors.past :
                                                   0.,
                     "is open and carries a force");
        errors.length(-gap, "penetrates");
      }
    else
      errors.length(std::abs(gap), "is closed and has a gap");
    // Each part of an increment slips its own way; their sum obeys nothing
    // but the cone.
    if (claim.whole && nt > 0 && point.mu > 0 &&
        claim.states[i] == solvers::NodeState::stick)
      errors.length(slip.norm(), "sticks and slips");
    if (claim.whole && nt > 0 && claim.states[i] == solvers::NodeState::slip)
      {
        errors.force(limit - r_t.norm(), "slips below the limit of friction");
        const double shortest =
          errors.position +
          (errors.k > 0 ? tolerance * errors.F / errors.k : 0.);
        // A slip that is rounding has no direction, and a longer one has it
        // up to position / |slip|.
        if (slip.norm() > shortest)
          errors.force((r_t + limit * slip / slip.norm()).norm() -
                         limit * errors.position / slip.norm(),
                       "does not slip against its friction");
      }
    return errors;
  }

  void
  Verification::check_law(const Claim  &claim,
                          const Scales &scales,
                          Finding      &out) const
  {
    for (std::size_t i = 0; i < points.all().size(); ++i)
      {
        const LawErrors errors = i < points.size() ?
                                   law_errors(i, claim, scales, out) :
                                   bound_errors(points.all()[i], scales, out);
        if (!(errors.worst <= out.residual))
          out.residual = errors.worst;
        if (!(errors.worst <= tolerance) && out.why.empty())
          out.why = place(bodies, points.all()[i]) + errors.what + ", by " +
                    to_text(errors.worst) +
                    " of the largest force on a node of its body";
      }
  }

  /* Supports take whatever a tie carries that they make redundant, at no
     displacement, and as a scale this force would excuse any error. */
  void
  Verification::check_bound_forces(const Claim &claim, Finding &out) const
  {
    constexpr double largest_lever = 1e4; // of what acts, and what is strained
    if (bound_stiffness.size() == 0)
      return;
    double cause = solvers::largest(claim.loads) +
                   bound_stiffness.maxCoeff() * solvers::largest(claim.w);
    for (const contact::Foundation &foundation : out.foundations)
      cause = std::max(cause, solvers::largest(foundation.forces));
    bool strained = false;
    for (std::size_t i = points.size(); i < points.all().size(); ++i)
      {
        const contact::ContactPoint &point = points.all()[i];
        const double force = contact::force_of(point, claim.r).norm();
        if (force <= largest_lever * cause)
          continue;
        if (!strained) // only where it matters: bound nodes of thin bodies
                       // give way more than what is pressed there is strained
          cause += solvers::largest(elastic.terms(claim.w));
        strained = true;
        if (force <= largest_lever * cause)
          continue;
        out.residual = std::numeric_limits<double>::infinity();
        if (out.why.empty())
          out.why = place(bodies, point) +
                    "is bound where supports hold it already, and what it "
                    "carries is not determined. Take it out of the support or "
                    "of the contact";
        return;
      }
  }

  void
  Verification::find_changes(const double t, Finding &out) const
  {
    out.displacements = relative_displacements(points.all(), out.u, t);
    out.change        = out.displacements;
    if (last.u.size() > 0)
      // of the same nodes and foots, where they were
      out.change -= relative_displacements(points.all(), last.u, last.t);
    out.change_as_before = out.change;
    if (!last.points.empty())
      out.change_as_before =
        relative_displacements(last.points, out.u, t) -
        relative_displacements(last.points, last.u, last.t);
  }

  /* Supports and contacts that hold a body which only strains itself take up
     what its forces leave when they cancel, at all of its nodes together. */
  double
  Verification::rounding_of(const unsigned int body,
                            const Claim       &claim,
                            const Balance     &balance,
                            const VectorXd    &carried,
                            VectorXd          &rounding) const
  {
    const Index first = plain.offset(body);
    const Index n     = plain.offset(body + 1) - first;
    if (balance.forces + balance.largest_moment == 0 ||
        (claim.mechanical.segment(first, n).array() != 0).any())
      return 0;
    const auto is_turn = [&](const unsigned int b, const Index dof) {
      return (dof - plain.offset(b)) % bodies.structures[b]->n_components() >=
             bodies.dim;
    };
    double largest[2] = {0, 0}; // of forces and of moments
    for (Index i = first; i < first + n; ++i)
      largest[is_turn(body, i)] =
        std::max(largest[is_turn(body, i)], std::abs(claim.loads[i]));
    if (balance.largest <= noise * largest[0] &&
        balance.largest_moment <= noise * largest[1])
      return noise * largest[0];
    if (balance.error() <= tolerance)
      return 0;
    if (rounding.size() == 0) // only where it may matter
      rounding =
        8 * eps * elastic.terms(claim.w) + rounding_of_supports(claim.t);
    double sum[2] = {0, 0};
    for (Index i = first; i < first + n; ++i)
      sum[is_turn(body, i)] += rounding[i];
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
  Verification::find_rounding(const Claim &claim, Finding &out) const
  {
    VectorXd rounding; // of all dofs
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      out.rounding.push_back(rounding_of(
        body, claim, out.external.bodies[body], out.carried, rounding));
    return *std::max_element(out.rounding.begin(), out.rounding.end()) > 0;
  }

  void
  Verification::forget_rounding(VectorXd &rest, Finding &out) const
  {
    const auto is_idle = [&](const unsigned int body) {
      return out.rounding[body] > 0;
    };
    for (unsigned int body = 0; body < out.rounding.size(); ++body)
      if (is_idle(body))
        {
          const Index first = plain.offset(body);
          const Index n     = plain.offset(body + 1) - first;
          rest.segment(first, n).setZero();
          for (contact::Foundation &foundation : out.foundations)
            if (foundation.forces.size() > 0)
              foundation.forces.segment(first, n).setZero();
        }
    for (const contact::ContactPoint &point : points.all())
      if (is_idle(point.node->body) && !point.node->opening &&
          (point.node->masters.empty() || is_idle(point.node->master)))
        out.r.segment(point.first, static_cast<Index>(point.dual.size()))
          .setZero();
  }

  Finding
  Verification::judge(const Claim &claim) const
  {
    Finding out;
    if (!claim.amounts.allFinite() || !claim.w.allFinite() ||
        !claim.r.allFinite())
      {
        out.why      = "its displacements or forces are not finite";
        out.residual = out.equilibrium =
          std::numeric_limits<double>::infinity();
        return out;
      }
    // u = R a + w. Gaps see all of it, forces only w: K R = 0 is exact where
    // nobody computes it.
    out.u = plain.displacements(motions.field(claim.amounts) + claim.w);
    out.foundations   = elastic.foundations(out.u, claim.t);
    VectorXd rest     = elastic.structure_forces(claim.w);
    out.strain_energy = .5 * claim.w.dot(rest);
    rest -= claim.loads;
    for (const contact::Foundation &foundation : out.foundations)
      if (foundation.forces.size() > 0)
        rest -= foundation.forces;
    for (const contact::ContactPoint &point : points.all())
      {
        const Tensor<1, 3> force = contact::force_of(point, claim.r);
        pairing::for_each_side(*point.node,
                               [&](const unsigned int body,
                                   const unsigned int node,
                                   const double       weight) {
                                 const Tensor<1, 3> f =
                                   bodies.in_frame(body, weight * force);
                                 for (unsigned int c = 0; c < bodies.dim; ++c)
                                   rest[plain.dof(body, node) + c] -= f[c];
                               });
      }
    out.unbalanced = rest;
    // Reactions of supports are read at the nodes that carry them.
    plain.unhang(rest);
    out.r              = claim.r;
    out.carried        = rounding_of_springs(out);
    const auto collect = [&] {
      out.external = external_forces(bodies,
                                     plain,
                                     points,
                                     plain.forces_in_space(rest),
                                     out.foundations,
                                     plain.forces_in_space(claim.mechanical),
                                     out.r);
    };
    collect();
    if (find_rounding(claim, out))
      {
        forget_rounding(rest, out);
        collect();
        for (std::size_t body = 0; body < out.rounding.size(); ++body)
          if (out.rounding[body] > 0)
            out.external.bodies[body] = Balance();
      }
    // Thermal forces are loads here: K w balances them as well, and the energy
    // of w contains their work.
    out.acting = plain.forces_in_space(claim.loads) + out.external.held;
    find_changes(claim.t, out);
    out.missed_by_bound = out.displacements.tail(points.n_bound_unknowns()) +
                          points.gaps_to_close();
    const Scales limits = scales(claim, out);
    out.largest_force   = limits.nodal;
    check_nodes(claim, limits, out);
    check_bodies(limits, out);
    check_law(claim, limits, out);
    check_bound_forces(claim, out);
    return out;
  }

  void
  Verification::save(Archive &archive) const
  {
    archive.put("verification/u", last.u);
    archive.put("verification/t", last.t);
    archive.put("verification/history", past.force);
    archive.put("verification/springs", past.on_springs);
    archive.put("verification/supports", past.on_supports);
  }

  void
  Verification::restore(const Archive &archive)
  {
    last.u.setZero(plain.n_dofs());
    archive.fill("verification/u", last.u);
    archive.fill("verification/t", last.t);
    archive.fill("verification/history", past.force);
    archive.fill("verification/springs", past.on_springs);
    archive.fill("verification/supports", past.on_supports);
    remember_contacts();
  }

  void
  Verification::remember_contacts()
  {
    if (!points.slide())
      return;
    last.nodes  = points.nodes();
    last.points = points.all();
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
    for (std::size_t body = 0; body < past.force.size(); ++body)
      past.force[body] =
        std::max(past.force[body], finding.largest_force[body]);
    for (const contact::Foundation &foundation : finding.foundations)
      lengthen(past.on_springs, foundation.ground);
    lengthen(past.on_supports, plain.prescribed(t));
  }
} // namespace conetact::verification
