// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/iterative_limits.h"

#include "conetact/base/text.h"
#include "conetact/contact/contact_axes.h"
#include "conetact/contact/hierarchical_means.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace conetact::contact
{
  namespace
  {
    using Nodes = std::set<std::pair<unsigned int, unsigned int>>;

    /** Bound points, and those of other contacts that have the axes of their
     * nodes. */
    std::vector<const ContactPoint *>
    points_with_axes(const ContactPoints &points)
    {
      std::vector<const ContactPoint *> result;
      const ContactAxes                 axes(points);
      for (const auto &[point, first] : axes.own())
        result.push_back(point);
      for (std::size_t i = points.size(); i < points.all().size(); ++i)
        result.push_back(&points.all()[i]);
      return result;
    }

    /** A node that has several of these, if any: all are bound. */
    const pairing::ContactNode *
    shared_node(const std::vector<const ContactPoint *> &points)
    {
      Nodes nodes;
      for (const ContactPoint *point : points)
        // Two bound points of a node would be two sets of axes. Of other
        // contacts ContactAxes has chosen one.
        if (!nodes.insert({point->node->body, point->node->node}).second)
          return point->node;
      return nullptr;
    }

    /**
     * A node that has unknowns of its own contact, and has those of another
     * node relative to it: what unknowns are relative to must be relative to
     * nothing else. Or none.
     */
    const pairing::ContactNode *
    faced_slave(const std::vector<const ContactPoint *> &points)
    {
      std::map<std::pair<unsigned int, unsigned int>,
               const pairing::ContactNode *>
        slaves;
      for (const ContactPoint *point : points)
        if (!point->node->masters.empty() || point->node->is_bound())
          slaves[{point->node->body, point->node->node}] = point->node;
      for (const ContactPoint *point : points)
        for (const auto &[node, weight] : point->node->masters)
          if (const auto found = slaves.find({point->node->master, node});
              found != slaves.end())
            return found->second;
      return nullptr;
    }

    /**
     * Tells whether a mean over nodes has others in it that meet something or
     * hang, or hardly its own one: the mean is the unknown, and tells the
     * displacement of its own node over its weight, which is too small to
     * divide by.
     */
    bool
    has_tangled_means(const model::Bodies                     &bodies,
                      const ContactPoints                     &points,
                      const std::vector<const ContactPoint *> &with_axes,
                      const NodeRules                         &supports)
    {
      constexpr double        least = .05;
      const HierarchicalMeans means(bodies, supports, points);
      Nodes                   nodes;
      for (const ContactPoint &point : points.all())
        if (!point.node->meets_nothing())
          nodes.insert({point.node->body, point.node->node});
      const auto hangs = [&](const unsigned int body, const unsigned int node) {
        const NodeRule *const rule = supports.find(body, node);
        return rule != nullptr && !rule->masters.empty();
      };
      const auto is_tangled = [&](const ContactPoint *const point) {
        const pairing::ContactNode &own = *point->node;
        if (own.slaves.empty())
          return false;
        const auto slaves = means.weights(own);
        return means.own_weight(own) < least ||
               std::any_of(slaves.begin(),
                           slaves.end(),
                           [&](const auto &slave) {
                             const unsigned int i = slave.first;
                             return i != own.node &&
                                    (nodes.count({own.body, i}) > 0 ||
                                     hangs(own.body, i));
                           });
      };
      return std::any_of(with_axes.begin(), with_axes.end(), is_tangled);
    }

    /**
     * Along unit vectors 1 - cos is half the square of the angle: 1e-12 stands
     * for about 1e-6 rad.
     */
    bool
    is_along(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      return std::abs(a * b) > 1 - 1e-12;
    }

    /** Tells whether supports hold all masters of a node along a direction. */
    bool
    are_masters_held(const pairing::ContactNode &node,
                     const Tensor<1, 3>         &direction,
                     const NodeRules            &supports)
    {
      return std::all_of(
        node.masters.begin(), node.masters.end(), [&](const auto &master) {
          const NodeRule *rule = supports.find(node.master, master.first);
          return master.second == 0 ||
                 (rule != nullptr && rule->masters.empty() &&
                  is_spanned(direction, directions(rule->held)));
        });
    }

    /** Tells whether a tie opens along a direction, that is, one that is not at
     * a right angle to the axis of its cut. */
    bool
    opens_along(const pairing::ContactNode &node,
                const Tensor<1, 3>         &direction,
                const model::Bodies        &bodies)
    {
      return node.opening &&
             std::any_of(bodies.cuts.begin(),
                         bodies.cuts.end(),
                         [&](const model::Cut &cut) {
                           return cut.body == *node.opening &&
                                  std::abs(cut.axis * direction) > 1e-12;
                         });
    }

    /**
     * Tells whether each direction that supports hold a bound node along is one
     * of its own: a frictionless one, or one that is bound to masters which
     * supports hold as well. Along these the node follows supports, along
     * others its masters.
     */
    bool
    is_bound_or_held(const ContactPoint  &point,
                     const NodeRules     &supports,
                     const model::Bodies &bodies)
    {
      const NodeRule *rule = supports.find(point.node->body, point.node->node);
      if (rule == nullptr)
        return true;
      const auto is_one_of = [&](const Tensor<1, 3> &h, const auto &all) {
        return std::any_of(all.begin(), all.end(), [&](const auto &direction) {
          return is_along(h, bodies.in_frame(point.node->body, direction));
        });
      };
      return rule->masters.empty() &&
             std::all_of(rule->held.begin(),
                         rule->held.end(),
                         [&](const HeldDirection &h) {
                           return !opens_along(*point.node,
                                               h.direction,
                                               bodies) &&
                                  (is_one_of(h.direction, point.frictionless) ||
                                   (is_one_of(h.direction, point.directions) &&
                                    are_masters_held(*point.node,
                                                     h.direction,
                                                     supports)));
                         });
    }
  } // namespace



  /* Sentences go on after "Backend = iterative": what comes first is told. */
  std::string
  why_not_iterative(const model::Bodies &bodies,
                    const NodeRules     &supports,
                    const ContactPoints &points)
  {
    for (const bodies::Support &support : bodies.supports)
      if (bodies.is_free_obstacle(support.body) && !support.is_still())
        return "solves bodies that deform, and " + bodies.called(support.body) +
               " is rigid and free, and moved as well";
    for (std::size_t i = points.size(); i < points.all().size(); ++i)
      if (!is_bound_or_held(points.all()[i], supports, bodies))
        return "knows no ties and no bilateral contacts of nodes that supports "
               "hold askew, or where these do not hold what it meets";
    const auto with_axes = points_with_axes(points);
    if (const pairing::ContactNode *node = shared_node(with_axes))
      return "wants each node in one tie or bilateral contact, and that at " +
             to_text(node->position) + " of " + bodies.called(node->body) +
             " is in several";
    if (points.traits().has_prescribed_slip)
      return "knows no friction along what supports hold";
    if (has_tangled_means(bodies, points, with_axes, supports))
      return "knows means over nodes, of a mortar surface or of faces of second "
             "degree, only where they hang on no others and meet nothing by "
             "themselves, as on a flat side that the other one covers: let the "
             "narrower body be the slave, refine its surface evenly, or set "
             "Pairing = node to face or Element = Q1";
    if (const pairing::ContactNode *node = faced_slave(with_axes))
      return "wants each node to face others or to be faced, and that at " +
             to_text(node->position) + " of " + bodies.called(node->body) +
             " does both, in two contacts";
    return "";
  }
} // namespace conetact::contact
