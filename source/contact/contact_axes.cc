// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_axes.h"

#include <cmath>
#include <map>

namespace conetact::contact
{
  namespace
  {
    /**
     * Whether the first of two contacts of a node is the one to have the axes:
     * what holds the node, so that the others find it held, or what is nearest;
     * of what is as near an obstacle, which is no other node.
     */
    bool
    has_axes_before(const pairing::ContactNode &one,
                    const pairing::ContactNode &other)
    {
      constexpr double same = 1e-6; // of an edge
      if (one.is_bound() != other.is_bound())
        return one.is_bound();
      if (one.meets_nothing() != other.meets_nothing())
        return other.meets_nothing();
      if (std::abs(one.gap - other.gap) > same * one.spacing)
        return one.gap < other.gap;
      return one.masters.empty() && !other.masters.empty();
    }
  } // namespace

  /* A node has three unknowns and can be turned to one contact only. All other
     contacts of it are written as rows beside the system (FurtherContacts).
     Springs act along a line that is no axis of a node. */
  ContactAxes::ContactAxes(const ContactPoints &points)
  {
    using Node = std::pair<unsigned int, unsigned int>;
    std::map<Node, std::size_t> best;
    for (std::size_t i = 0; i < points.all().size(); ++i)
      {
        const pairing::ContactNode &node = *points.all()[i].node;
        if (node.spring)
          continue;
        const auto [it, is_new] = best.insert({{node.body, node.node}, i});
        if (!is_new && has_axes_before(node, *points.all()[it->second].node))
          it->second = i;
      }
    std::vector<double> mu;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const ContactPoint &point  = points[i];
        const auto          number = static_cast<Index>(i);
        if (point.node->spring ||
            best[{point.node->body, point.node->node}] != i)
          {
            further.push_back(number);
            continue;
          }
        with_axes.emplace_back(&point, own_layout.n_unknowns());
        numbers.push_back(number);
        own_layout.first.push_back(own_layout.n_unknowns() +
                                   static_cast<Index>(point.dual.size()));
        mu.push_back(point.mu);
      }
    own_layout.mu =
      Eigen::Map<const Eigen::VectorXd>(mu.data(),
                                        static_cast<Index>(mu.size()));
  }
} // namespace conetact::contact
