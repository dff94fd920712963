// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/verification/contact_law.h"

#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace conetact::verification
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** A relative displacement has this rounding over the positions that it is
     * the difference of: each is a sum of a few terms. */
    constexpr double rounding_of_positions =
      16 * std::numeric_limits<double>::epsilon();

    std::string
    place(const model::Bodies &bodies, const contact::ContactPoint &point)
    {
      return "the contact node at " + to_text(point.node->position) +
             " of body '" + bodies.names[point.node->body] + "' ";
    }

    /** A node as the laws of its contact see it, by their definitions. */
    struct Seen
    {
      double   limit; ///< of friction, along the first axis [force]
      double   pull;  ///< of its bond, at most [force]
      double   gap;   ///< with what layers and wear take [length]
      VectorXd slip;  ///< without what layers give way by [length]
      /** Along the second axis, if it is another one [force]. */
      std::optional<double> second = {};

      /** Friction beyond its limit [force]. */
      double
      beyond(const VectorXd &r_t) const
      {
        return second ? -left_of_ellipse(r_t) :
                        r_t.norm() - std::max(limit, 0.);
      }
      /** Friction at the slip s: -f s / |s| or, along the normal of an ellipse
       * with semi-axes f_k, -f_k^2 s_k / |(f_1 s_1, f_2 s_2)| [force]. */
      VectorXd
      friction(const double way) const
      {
        if (!second)
          return -limit / way * slip;
        const Eigen::Vector2d axes(limit, *second), e = axes.cwiseProduct(slip);
        const double          size = e.norm();
        return size > 0 ? VectorXd(-axes.cwiseProduct(e) / size) :
                          VectorXd(VectorXd::Zero(2));
      }
      /** Bounds |dr/ds|: f / |s|, or (max f_k)^2 / |(f_1 s_1, f_2 s_2)| on an
       * ellipse [force/length]. */
      double
      turning(const double way) const
      {
        if (!second)
          return limit / way;
        const Eigen::Vector2d axes(limit, *second);
        const double          most = axes.maxCoeff();
        const double          size = axes.cwiseProduct(slip).norm();
        return size > 0 ? most * most / size : 0.;
      }

    private:
      /** The distance from r_t to the ellipse along r_t, negative outside; an
       * axis without friction bears nothing. */
      double
      left_of_ellipse(const VectorXd &r_t) const
      {
        const Eigen::Vector2d axes(limit, *second);
        double                part = 0;
        for (const Index k : {0, 1})
          if (axes[k] > 0)
            part = std::hypot(part, r_t[k] / axes[k]);
          else if (r_t[k] != 0)
            return -std::abs(r_t[k]);
        return part > 0 ? r_t.norm() * (1 / part - 1) : axes.maxCoeff();
      }
    };

    /** The radius of the ellipse of friction along the one tangent t that
     * supports leave, 1 / |((a_1 . t) / f_1, (a_2 . t) / f_2)|. */
    double
    width_along(const pairing::ContactNode &node,
                const Tensor<1, 3>         &tangent,
                const double                one,
                const double                two)
    {
      double sum = 0;
      for (const auto &[axis, limit] :
           {std::pair(node.axis_1, one), std::pair(node.axis_2, two)})
        if (const double part = std::abs(axis * tangent); part > 1e-12)
          sum = std::hypot(sum,
                           limit > 0 ? part / limit :
                                       std::numeric_limits<double>::infinity());
      return 1 / sum;
    }

    /** The area on which a bond holds. One that softens does so in this very
     * increment, a brittle one breaks at the end of one. */
    double
    rest_of_bond(const pairing::ContactNode &node,
                 const pairing::Situation   &here,
                 const Seen                 &seen)
    {
      const pairing::BondLaw &law   = *node.bond;
      const bool              now   = !law.is_brittle();
      const double            gap   = std::max(seen.gap, 0.);
      const double            least = node.least_opening();
      const double opened = now ? std::max(here.opened, gap) : here.opened;
      const double shorn  = here.shorn + (now ? seen.slip.norm() : 0.);
      return law.rest(opened, shorn, least) * node.bonded_area();
    }

    /** The limit of friction along an axis, mu r_n + c a but at most that of
     * the law, where `bond` is the area a on which a bond holds [length^2]. */
    double
    limit_along(const unsigned int          axis,
                const pairing::ContactNode &node,
                const pairing::Situation   &here,
                const double                r_n,
                const double                bond)
    {
      double limit = node.friction->coefficient(here, axis) * r_n;
      if (bond > 0)
        limit += bond * node.bond->cohesion(here);
      limit = std::min(limit,
                       node.friction->largest_force(here, node.covered_area()));
      // A coefficient or a limit that falls below 0 is none.
      return std::max(limit, 0.);
    }

    /**
     * A node as its laws define it: where `slip` and `gap` are those of the
     * bodies the law of contact holds for (slip + C_t (r_t - r_t0) / a, gap +
     * w), with friction r_t0 at the start of the increment, the area a and w,
     * what pressure closes a layer by and wear takes. Speeds are made of slips
     * with their shear.
     */
    Seen
    seen_by_laws(const Claim                 &claim,
                 const std::size_t            i,
                 const contact::ContactPoint &point,
                 const VectorXd              &r_t,
                 const double                 r_n,
                 const double                 gap,
                 VectorXd                     slip)
    {
      const contact::CandidateLaw   &law   = (*claim.laws)[i];
      const contact::CandidateStart &start = law.start();
      const pairing::ContactNode    &node  = *point.node;
      const double                   area  = node.covered_area();
      pairing::Situation             here  = start.situation;
      if (area > 0)
        here.pressure = std::max(r_n, 0.) / area;
      if (node.layer && area > 0)
        slip += node.layer->shear(here) / area * (r_t - start.friction);
      here.speed = slip.norm() / start.duration;
      Seen seen{0, 0, gap + claim.worn[static_cast<Index>(i)], slip};
      if (node.layer)
        // A bond that is pulled stretches its layer by the compliance that it
        // has without pressure.
        seen.gap += node.bond && r_n < 0 && area > 0 ?
                      r_n / area * node.layer->closing_by_pressure(here) :
                      node.layer->closing(here);
      if (node.spring)
        seen.gap += std::max(r_n, 0.) * node.spring->compliance();
      if (node.layer && node.layer->wears_at_once())
        seen.gap +=
          here.pressure * node.layer->wear_by_pressure(here) * slip.norm();
      double bond = 0, pressing = r_n;
      if (!law.sees())
        seen.gap = std::numeric_limits<double>::infinity();
      else if (node.bond)
        {
          // r_n + pull >= 0 takes the place of r_n >= 0.
          bond      = rest_of_bond(node, here, seen);
          seen.pull = bond * node.bond->strength(here) *
                      node.bond->unloading(std::max(seen.gap, 0.),
                                           here.opened,
                                           node.least_opening());
        }
      if (law.is_wet()) // the fluid's part of the reaction has no friction
        {
          const double force = node.fluid->pressure(here.t) * area;
          pressing -= force;
          here.pressure = std::max(pressing, 0.) / area;
          seen.pull -= force;
        }
      seen.limit = limit_along(0, node, here, pressing, bond);
      if (node.friction->is_elliptic() && slip.size() > 0)
        {
          const double two = limit_along(1, node, here, pressing, bond);
          if (slip.size() == 2)
            seen.second = two;
          else
            seen.limit =
              width_along(node, point.directions.front(), seen.limit, two);
        }
      return seen;
    }
  } // namespace



  double
  relative(const double error, const double scale)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (error <= 0)
      return 0;
    return scale > 0 && error < infinity ? error / scale : infinity;
  }



  ContactLaw::ContactLaw(const model::Bodies          &b,
                         const contact::ElasticSystem &e,
                         const contact::ContactPoints &contacts,
                         const double                  tol)
    : bodies(b)
    , elastic(e)
    , points(contacts)
    , tolerance(tol)
    , stiffness(VectorXd::Zero(static_cast<Index>(points.size())))
  {}



  void
  ContactLaw::set_stiffness(const VectorXd &of_candidates,
                            const VectorXd &of_bound)
  {
    AssertDimension(of_candidates.size(), static_cast<Index>(points.size()));
    Assert(of_bound.size() == 0 || of_bound.size() == points.n_bound_unknowns(),
           dealii::ExcMessage(
             "A stiffness along each unknown of what is bound, or none."));
    stiffness       = of_candidates;
    bound_stiffness = of_bound;
  }



  /** How a contact node breaks the law; all errors become forces over F. */
  struct ContactLaw::Errors
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
        // error <= tol F / k + position is (error - position) k <= tol F.
        // Without a stiffness k only rounding is allowed.
        take(k > 0 ? relative((error - position) * k - past, F) :
                     std::numeric_limits<double>::infinity(),
             name);
    }
    /** Slips, and openings against a bond, go against their friction. */
    void
    slide(const Seen     &seen,
          const VectorXd &r_t,
          const bool      slips,
          const double    tolerance)
    {
      if (slips)
        force(-seen.beyond(r_t), "slips below the limit of friction");
      const double way = seen.slip.norm();
      // A slip that is rounding has no direction, and a longer one has it
      // up to position / |slip|.
      if (way > position + (k > 0 ? tolerance * F / k : 0.))
        force((r_t - seen.friction(way)).norm() - seen.turning(way) * position,
              "does not slip against its friction");
    }
  };



  ContactLaw::Errors
  ContactLaw::errors_of(const pairing::ContactNode &node,
                        const double                k,
                        const Scales               &scales) const
  {
    AssertIndexRange(node.body, scales.force.size());
    AssertDimension(scales.rounding.size(), scales.force.size());
    AssertDimension(scales.reach.size(), scales.force.size());
    const unsigned int other = node.masters.empty() ? node.body : node.master;
    return {// A light body on a heavily loaded one is judged by its own forces.
            std::min(scales.force[node.body], scales.force[other]),
            std::max({scales.noise,
                      scales.rounding[node.body],
                      scales.rounding[other]}),
            // Displacements v are differences of positions.
            rounding_of_positions *
              std::max(scales.reach[node.body], scales.reach[other]),
            k};
  }



  /* Any reaction will do: only places are judged. */
  ContactLaw::Errors
  ContactLaw::errors_of_bound(const contact::ContactPoint &point,
                              const Scales                &scales,
                              const Finding               &out) const
  {
    Assert(point.first >= points.n_unknowns(),
           dealii::ExcMessage(
             "Unknowns of what is bound stand behind all others."));
    AssertDimension(out.missed_by_bound.size(), points.n_bound_unknowns());
    const Index  first  = point.first - points.n_unknowns();
    const auto   n      = static_cast<Index>(point.dual.size());
    const double k      = bound_stiffness.size() > 0 ?
                            bound_stiffness.segment(first, n).minCoeff() :
                            0.;
    Errors       errors = errors_of(*point.node, k, scales);
    errors.length(
      out.missed_by_bound.segment(first, n).norm(),
      point.node->kind == pairing::ContactKind::tie ?
        "is tied and moves against what it is tied to (supports or a "
        "Gap may contradict the tie)" :
        "is bound and leaves what it is bound to (supports or a "
        "Gap may contradict that)");
    return errors;
  }



  /* r_n + pull >= 0, |r_t| <= f; open: r_n + pull = 0, g >= 0; closed: g = 0;
     stuck: no slip; slipping: friction at its limit, against the slip. In
     compliant layers slip and g are those of seen_by_laws(). */
  ContactLaw::Errors
  ContactLaw::errors_of_candidate(const std::size_t i,
                                  const Claim      &claim,
                                  const Scales     &scales,
                                  const Finding    &out) const
  {
    AssertIndexRange(i, points.size());
    AssertDimension(out.displacements.size(), points.n_all_unknowns());
    AssertDimension(out.change.size(), out.displacements.size());
    const contact::ContactPoint &point = points[i];
    const pairing::ContactNode  &node  = *point.node;
    Errors errors = errors_of(node, stiffness[static_cast<Index>(i)], scales);

    const auto     nt   = static_cast<Index>(point.dual.size()) - 1;
    const Index    n    = point.first + nt;
    const double   r_n  = claim.r[n];
    const VectorXd r_t  = claim.r.segment(point.first, nt);
    Seen           seen = {point.mu * r_n +
                             node.cohesion, // which holds at open nodes, too
                           0,
                           node.gap + out.displacements[n],
                           (claim.incremental ? out.change : out.displacements)
                             .segment(point.first, nt)};
    if (claim.laws && (*claim.laws)[i].sees() && node.is_joined())
      {
        if (claim.states[i] != solvers::NodeState::stick)
          errors.take(std::numeric_limits<double>::infinity(),
                      "is joined and called open or slipping");
        if (node.spring)
          errors.length(std::abs(seen.gap + r_n * node.spring->compliance()),
                        "is a spring and has another force than its way");
        else
          errors.length(out.change.segment(point.first, nt + 1).norm(),
                        "is tied and moves against what it is tied to");
        return errors;
      }
    if (claim.laws && node.friction)
      seen = seen_by_laws(claim, i, point, r_t, r_n, seen.gap, seen.slip);
    const double    limit = seen.limit, gap = seen.gap;
    const VectorXd &slip = seen.slip;

    const double s = r_n + seen.pull;
    if (limit < 0 && r_n > 0)
      errors.force(-limit, "has a coefficient of friction below 0");
    errors.force(-s,
                 seen.pull > 0 ? "is pulled by more than its bond bears" :
                 seen.pull < 0 ? "carries less than the fluid there" :
                                 "is pulled by its contact");
    errors.force(seen.beyond(r_t), "carries more than friction");
    if (claim.states[i] == solvers::NodeState::open)
      {
        // The zeros of open nodes are exact: all of what exceeds rounding
        // counts, and force() must not take rounding off once more.
        if (seen.pull != 0)
          errors.force(s,
                       "is open and carries more than its bond or its fluid");
        else
          errors.force(std::abs(s) > errors.past ? std::abs(s) + errors.past :
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
    const bool slips = claim.states[i] == solvers::NodeState::slip;
    const bool opens = claim.states[i] == solvers::NodeState::open;
    if (claim.whole && nt > 0 && (slips || (opens && node.bond)))
      errors.slide(seen, r_t, slips, tolerance);
    return errors;
  }



  void
  ContactLaw::check(const Claim  &claim,
                    const Scales &scales,
                    Finding      &out) const
  {
    for (std::size_t i = 0; i < points.all().size(); ++i)
      {
        const Errors errors = i < points.size() ?
                                errors_of_candidate(i, claim, scales, out) :
                                errors_of_bound(points.all()[i], scales, out);
        if (!(errors.worst <= out.residual))
          out.residual = errors.worst;
        if (!(errors.worst <= tolerance) && out.why.empty())
          out.why = place(bodies, points.all()[i]) + errors.what + ", by " +
                    to_text(errors.worst) +
                    " of the largest force on a node of its body";
      }
    check_bound_forces(claim, out);
  }



  /* A support takes whatever a tie carries that it makes redundant, at no
     displacement, and as a scale this force would excuse any error. It must
     have a cause: loads, springs or strain, which levers multiply, but hardly
     by 1e4. */
  void
  ContactLaw::check_bound_forces(const Claim &claim, Finding &out) const
  {
    constexpr double largest_lever = 1e4; // over what acts or is strained
    if (bound_stiffness.size() == 0)
      return;
    double cause = solvers::largest(*claim.loads) +
                   bound_stiffness.maxCoeff() * solvers::largest(*claim.w);
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
          cause += solvers::largest(elastic.terms(*claim.w));
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
} // namespace conetact::verification
