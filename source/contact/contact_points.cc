// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_points.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/bound_nodes.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    /** A slip along a support that is less than this part of the spacing of
     * nodes is the rounding of expressions, and none. */
    constexpr double least_slide = 1e-12;

    void
    add_cone(ContactPoint       &point,
             const Tensor<1, 3> &tangent,
             const double        scale)
    {
      point.directions.push_back(scale * tangent);
      point.dual.push_back(tangent / scale);
    }

    /**
     * The elliptic cone becomes a circular one of coefficient mu = sqrt(mu_1
     * mu_2) in the coordinates u_k mu_k/mu, the forces r_k mu/mu_k: same work,
     * [K] remark 3.3. An axis without friction has no unknown, and no part in
     * the cone.
     */
    void
    add_both_tangents(ContactPoint &point)
    {
      const pairing::ContactNode &node = *point.node;
      point.mu                         = node.mu_1 == node.mu_2 ? node.mu_1 :
                                         node.mu_1 > 0 && node.mu_2 > 0 ?
                                                                  std::sqrt(node.mu_1 * node.mu_2) :
                                                                  std::max(node.mu_1, node.mu_2);
      const auto add = [&](const Tensor<1, 3> &axis, const double mu) {
        if (mu > 0)
          add_cone(point, axis, point.mu / mu);
        else
          point.frictionless.push_back(axis);
      };
      add(node.axis_1, node.mu_1);
      add(node.axis_2, node.mu_2);
    }

    /** The one tangent that is left; mu is the cone's radius along it. */
    void
    add_one_tangent(ContactPoint &point, const Tensor<1, 3> &tangent)
    {
      const pairing::ContactNode &node = *point.node;
      // The ellipse (r_1 / mu_1)^2 + (r_2 / mu_2)^2 = r_n^2, cut along the
      // tangent; without friction along one axis a segment of the other one.
      const auto along = [&](const Tensor<1, 3> &axis, const double mu) {
        const double part = std::abs(tangent * axis);
        return part > 1e-12 ? part / mu : 0.;
      };
      point.mu = node.mu_1 == node.mu_2 ?
                   node.mu_1 :
                   1 / std::hypot(along(node.axis_1, node.mu_1),
                                  along(node.axis_2, node.mu_2));
      if (point.mu > 0 || node.cohesion > 0)
        add_cone(point, tangent, 1);
      else
        point.frictionless.push_back(tangent);
    }

    /** A sentence: neither along the normal nor across it is it held. */
    std::string
    why_oblique(const pairing::ContactNode &node,
                const NodeRule             &rule,
                const model::Bodies        &bodies)
    {
      const bodies::Support &support =
        bodies.supports[rule.held.back().terms.front().support];
      const std::string at =
        to_text(node.position) + " of body '" + bodies.names[node.body] + "'";
      if (bodies.are_axisymmetric() &&
          support.ids.empty()) // no entry: the axis
        return "The contact node at " + at +
               " lies on the axis, but its contact normal " + to_text(node.n) +
               " is not along it. A body of revolution (Plane = axisymmetric) "
               "meets an obstacle that goes round the axis, too: centre the "
               "obstacle on the axis, with its normal there along y, or take "
               "the node out of the contact.";
      return "Support '" + support.name + "' holds the contact node at " + at +
             " along " + to_text(rule.held.back().direction) +
             ", neither along its contact normal " + to_text(node.n) +
             " nor across it. Take the node out of the support or of "
             "the contact.";
    }

    /** How many unknowns each contact node has. */
    std::vector<std::size_t>
    unknowns_of(const std::vector<pairing::ContactNode> &nodes,
                const std::vector<ContactPoint>         &points)
    {
      std::vector<std::size_t> count(nodes.size());
      for (const ContactPoint &point : points)
        count[point.node - nodes.data()] += point.dual.size();
      return count;
    }
  } // namespace

  Tensor<1, 3>
  force_of(const ContactPoint &point, const Eigen::VectorXd &r)
  {
    AssertIndexRange(point.normal(), r.size());
    Tensor<1, 3> force;
    for (std::size_t k = 0; k < point.dual.size(); ++k)
      force += r[point.first + static_cast<Eigen::Index>(k)] * point.dual[k];
    return force;
  }

  ContactPoints::ContactPoints(const model::Bodies       &b,
                               const NodeRules           &s,
                               const std::vector<double> &times)
    : bodies(b)
    , supports(s)
  {
    if (const std::string why = add_all(times); !why.empty())
      throw InputError(why);
  }

  std::string
  ContactPoints::add_all(const std::vector<double> &times)
  {
    const BoundNodes bound(nodes());
    for (const pairing::ContactNode &node : nodes())
      if (node.is_bound())
        continue;
      else if (bound.hold(node)) // its gap cannot change: no unknown
        ++found_traits.n_held;
      else if (const std::string why = add(node, times); !why.empty())
        return why;
    n_candidates = points.size();
    for (const pairing::ContactNode &node : nodes())
      if (node.is_bound())
        add_bound(node);
    number();
    return {};
  }

  /* Whether any node is found again as bodies move. */
  bool
  ContactPoints::slide() const
  {
    return std::any_of(nodes().begin(), nodes().end(), [](const auto &node) {
      return node.slides;
    });
  }

  /* Solvers, states and histories count unknowns by the layout: points may turn
     and meet other nodes, but each keeps its number of unknowns. Coefficients
     that laws vary (set_friction) are those that were set last. */
  std::string
  ContactPoints::relink(std::vector<pairing::ContactNode> found,
                        const std::vector<double>        &times)
  {
    AssertDimension(found.size(), bodies.contact_nodes.size());
    const std::vector<std::size_t> unknowns_before =
      unknowns_of(nodes(), points);
    const solvers::ContactSystem before =
      std::exchange(contact_layout, solvers::ContactSystem());
    found_again  = std::move(found);
    found_traits = {};
    n_all        = 0;
    points.clear();
    const std::string why  = add_all(times);
    const auto        now  = unknowns_of(nodes(), points);
    bool              same = why.empty() && now == unknowns_before;
    // A constant coefficient is another along one tangent of an ellipse only.
    for (std::size_t i = 0; i < n_candidates && same; ++i)
      if (const auto k = static_cast<Eigen::Index>(i);
          points[i].node->friction || points[i].dual.size() == bodies.dim ||
          points[i].node->mu_1 == points[i].node->mu_2)
        contact_layout.mu[k] = points[i].mu = before.mu[k];
      else
        same = contact_layout.mu[k] == before.mu[k];
    if (same)
      return {};
    contact_layout = before; // what comes next must fit
    if (!why.empty())
      return why;
    const auto other =
      std::mismatch(now.begin(), now.end(), unknowns_before.begin()).first;
    const std::string at =
      other == now.end() ?
        "" :
        " at " + to_text(nodes()[other - now.begin()].position) + " of " +
          bodies.called(nodes()[other - now.begin()].body);
    return "A contact node" + at +
           " slides to where supports, ties or its law leave it other "
           "directions than where it came from. Take the nodes that supports "
           "or ties hold out of the contact, or set its Kinematics to small";
  }

  /* Coefficients of this increment, for all that asks the layout: existence,
     names of mechanisms, methods with cones. */
  void
  ContactPoints::set_friction(const Eigen::VectorXd &mu)
  {
    AssertDimension(mu.size(), contact_layout.mu.size());
    contact_layout.mu = mu;
    for (std::size_t i = 0; i < n_candidates; ++i)
      points[i].mu = mu[static_cast<Eigen::Index>(i)];
  }

  namespace
  {
    /**
     * A mean over faces reaches beyond a plane of symmetry, or an edge that is
     * held, and there nothing holds its master. Whether the master is held at
     * the node itself, as the node is: along all directions that a support
     * holds the node.
     */
    bool
    is_held_with_master(const NodeRule             &rule,
                        const pairing::ContactNode &node,
                        const NodeRules            &supports,
                        const model::Bodies        &bodies,
                        const std::vector<double>  &times)
    {
      const auto holds = [&](const NodeRule &master, const HeldDirection &own) {
        if (!is_spanned(own.direction, directions(master.held)))
          return false;
        const Point<3> there =
          bodies.structures[master.body]->position(master.node);
        return std::all_of(times.begin(), times.end(), [&](const double t) {
          double slip = supports.displacement(own, node.position, t);
          for (const HeldDirection &h : master.held)
            slip -= (h.direction * own.direction) *
                    supports.displacement(h, there, t);
          return std::abs(slip) <= least_slide * node.spacing;
        });
      };
      return std::all_of(
        rule.held.begin(), rule.held.end(), [&](const HeldDirection &own) {
          return std::any_of(
            node.masters.begin(), node.masters.end(), [&](const auto &master) {
              const NodeRule *found = supports.find(node.master, master.first);
              return found != nullptr && found->masters.empty() &&
                     holds(*found, own);
            });
        });
    }

    /**
     * Whether supports keep a node and its master in one plane of symmetry for
     * each direction that they hold the node along. There a mean over the
     * faces of one half slips along it by what the other half takes back. It
     * does not depend on what the node meets, which may change.
     */
    bool
    is_cut_with_master(const NodeRule             &rule,
                       const pairing::ContactNode &node,
                       const NodeRules            &supports,
                       const model::Bodies        &bodies,
                       const std::vector<double>  &times)
    {
      constexpr double same_plane = 1e-6; // of a cell, as files have digits
      const auto rests = [&](const HeldDirection &held, const Point<3> &p) {
        return std::all_of(times.begin(), times.end(), [&](const double t) {
          return std::abs(supports.displacement(held, p, t)) <=
                 least_slide * node.spacing;
        });
      };
      const auto is_cut = [&](const NodeRule &other, const HeldDirection &own) {
        if (other.body != node.master || !other.masters.empty() ||
            !is_spanned(own.direction, directions(other.held)))
          return false;
        const Point<3> there =
          bodies.structures[other.body]->position(other.node);
        return std::abs((there - node.position) * own.direction) <=
                 same_plane * node.spacing &&
               std::all_of(other.held.begin(),
                           other.held.end(),
                           [&](const HeldDirection &held) {
                             return rests(held, there);
                           });
      };
      return std::all_of(rule.held.begin(),
                         rule.held.end(),
                         [&](const HeldDirection &own) {
                           return rests(own, node.position) &&
                                  std::any_of(supports.rules().begin(),
                                              supports.rules().end(),
                                              [&](const NodeRule &other) {
                                                return is_cut(other, own);
                                              });
                         });
    }
  } // namespace

  /* A support that drags a node along what it touches: the slip is known
     beforehand, and the friction against it is a load on the support. Where
     nothing slides a reaction along it would be undetermined. */
  bool
  ContactPoints::slides_along_supports(const NodeRule             &rule,
                                       const pairing::ContactNode &node,
                                       const std::vector<double>  &times) const
  {
    if (rule.held.empty() || std::max(node.mu_1, node.mu_2) == 0)
      return false;
    const bool meets_body = node.obstacle == nullptr;
    const bool by_itself  = node.slides && !node.is_mean;
    if (meets_body &&
        (by_itself || bodies.structures[node.body]->meets_at_corners()) &&
        is_cut_with_master(rule, node, supports, bodies, times))
      return false;
    // Nodes beside one of a mean may move along what is held here; and what a
    // node meets changes as it slides, its unknowns do not.
    if (meets_body && (!node.slaves.empty() || node.slides))
      return true;
    if (node.is_mean && !node.slides &&
        is_held_with_master(rule, node, supports, bodies, times))
      return false;
    std::vector<std::pair<const NodeRule *, double>> masters;
    for (const auto &[master, weight] : node.masters)
      if (weight != 0)
        {
          const NodeRule *found = supports.find(node.master, master);
          if (found == nullptr || !found->masters.empty())
            return true; // its body may deform along anything held here
          masters.emplace_back(found, weight);
        }
    for (const HeldDirection &own : rule.held)
      {
        for (const auto &[master, weight] : masters)
          if (!is_spanned(own.direction, directions(master->held)))
            return true;
        for (const double t : times)
          {
            // Supports prescribe this slip along e, of the node less that of
            // what it meets: e . (d - d_obstacle - sum w_k d_k).
            double slip = supports.displacement(own, node.position, t);
            slip -= pairing::obstacle_displacement(node, t) * own.direction;
            for (const auto &[master, weight] : masters)
              for (const HeldDirection &h : master->held)
                slip -=
                  weight * (h.direction * own.direction) *
                  supports.displacement(
                    h,
                    bodies.structures[master->body]->position(master->node),
                    t);
            if (std::abs(slip) > least_slide * node.spacing)
              return true;
          }
      }
    return false;
  }

  std::string
  ContactPoints::add(const pairing::ContactNode &node,
                     const std::vector<double>  &times)
  {
    Assert(std::abs(node.n.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    const NodeRule                 *rule = supports.find(node.body, node.node);
    const std::vector<Tensor<1, 3>> held =
      rule != nullptr ? directions(rule->held) : std::vector<Tensor<1, 3>>();
    if (node.spring)
      {
        add_spring(node);
        return {};
      }
    // Its gap cannot change by deformation: no unknown.
    if (is_spanned(node.n, held))
      {
        ++found_traits.n_held;
        // Of a mean nobody else would take the pressure (give_up_held_nodes).
        if (node.is_mean && node.slides && !node.meets_nothing())
          return "Finite sliding: " + why_it_does_not_slide(node, bodies) + ".";
        return {};
      }
    if (!is_across(node.n, held))
      return why_oblique(node, *rule, bodies);

    ContactPoint point;
    point.node = &node;
    const bool slides =
      rule != nullptr && slides_along_supports(*rule, node, times);
    found_traits.has_prescribed_slip =
      found_traits.has_prescribed_slip || slides;
    const std::size_t n_left = bodies.dim - 1 - (slides ? 0 : held.size());
    // Tangents that supports hold have no unknowns, unless the slip along them
    // is prescribed: its friction is one.
    if (n_left == 2)
      add_both_tangents(point);
    else if (n_left == 1)
      add_one_tangent(point,
                      bodies.dim == 2 ? node.t1 :
                                        cross_product_3d(node.n, held[0]));
    // The normal comes last, as solvers want it.
    add_cone(point, node.n, 1);
    points.push_back(std::move(point));
    return {};
  }

  /* Supports hold its point or not: it may move all the same, and the other end
     anyway. */
  void
  ContactPoints::add_spring(const pairing::ContactNode &node)
  {
    ContactPoint point;
    point.node                               = &node;
    const std::vector<Tensor<1, 3>> tangents = {node.t1, node.t2};
    point.frictionless.assign(tangents.begin(),
                              tangents.begin() + bodies.dim - 1);
    add_cone(point, node.n, 1);
    points.push_back(std::move(point));
  }

  /* Supports take no rows away: what a support and a tie hold both, only one
     of them need carry, which the elimination of bound unknowns finds out. */
  void
  ContactPoints::add_bound(const pairing::ContactNode &node)
  {
    Assert(std::abs(node.n.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    ContactPoint point;
    point.node                               = &node;
    const std::vector<Tensor<1, 3>> tangents = {node.t1, node.t2};
    for (unsigned int k = 0; k + 1 < bodies.dim; ++k)
      if (node.kind == pairing::ContactKind::tie)
        add_cone(point, tangents[k], 1);
      else
        point.frictionless.push_back(tangents[k]);
    add_cone(point, node.n, 1);
    points.push_back(std::move(point));
  }

  /* What is bound closes its gap at once where it is told to (Gap): v_t = -g.
     Other ties keep the gap that is drawn, v_t = 0. */
  Eigen::VectorXd
  ContactPoints::gaps_to_close() const
  {
    Eigen::VectorXd gaps = Eigen::VectorXd::Zero(n_bound_unknowns());
    for (std::size_t i = n_candidates; i < points.size(); ++i)
      if (points[i].node->closes)
        gaps[points[i].normal() - n_unknowns()] = points[i].node->gap;
    return gaps;
  }

  /* Candidates come first, so that their unknowns are the first ones and those
     of what is bound stand behind. */
  void
  ContactPoints::number()
  {
    contact_layout.mu.resize(static_cast<Eigen::Index>(n_candidates));
    for (ContactPoint &point : points)
      {
        point.first = n_all;
        n_all += static_cast<Eigen::Index>(point.dual.size());
      }
    std::set<std::pair<unsigned int, unsigned int>> nodes;
    Eigen::Index                                    i = 0;
    for (const ContactPoint &point : *this)
      {
        contact_layout.mu[i++] = point.mu;
        contact_layout.first.push_back(
          point.first + static_cast<Eigen::Index>(point.dual.size()));
      }
    for (const ContactPoint &point : points)
      if (!nodes.insert({point.node->body, point.node->node}).second)
        found_traits.shares_nodes = true;
  }
} // namespace conetact::contact
