// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/bound_nodes.h"

#include "conetact/base/text.h"

#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /** Obstacles that are not free move as they are told, all of them. */
    constexpr int obstacles = -1;

    int
    opponent_of(const pairing::ContactNode &node)
    {
      return node.masters.empty() ? obstacles : static_cast<int>(node.master);
    }

    std::vector<Tensor<1, 3>>
    directions_of(const pairing::ContactNode &node)
    {
      return node.kind == pairing::ContactKind::tie ?
               std::vector<Tensor<1, 3>>{node.n, node.t1, node.t2} :
               std::vector<Tensor<1, 3>>{node.n};
    }
  } // namespace

  BoundNodes::BoundNodes(const std::vector<pairing::ContactNode> &nodes)
  {
    for (const pairing::ContactNode &node : nodes)
      {
        // A tie that slides, opens or is a mean leaves the node itself its
        // freedom.
        if (!node.is_bound() || node.slides || node.opening ||
            !node.slaves.empty())
          continue;
        all[{node.body, node.node}].push_back(
          {opponent_of(node), directions_of(node)});
        for (const auto &[master, weight] : node.masters)
          // A master that is the whole mean is bound as its slave is.
          if (std::abs(weight - 1) < 1e-9)
            all[{node.master, master}].push_back(
              {static_cast<int>(node.body), directions_of(node)});
      }
  }

  void
  BoundNodes::append(const pairing::ContactNode &node,
                     std::vector<Tensor<1, 3>>  &orthonormal) const
  {
    const auto found = all.find({node.body, node.node});
    // The ends of a spring are two places, and each is a mean over a cell.
    if (found == all.end() || node.is_bound() || node.slides || node.spring)
      return;
    for (const Bound &bound : found->second)
      if (bound.opponent == opponent_of(node))
        for (const Tensor<1, 3> &direction : bound.directions)
          add_direction(direction, orthonormal);
  }

  std::string
  why_it_does_not_slide(const pairing::ContactNode &node,
                        const model::Bodies        &bodies)
  {
    return "a support holds the contact node at " + to_text(node.position) +
           " of body '" + bodies.names[node.body] +
           "' along its contact normal, which mortar contacts that slide far "
           "do not know. Take it out of the support or of the contact, or "
           "choose Pairing = node to face";
  }
} // namespace conetact::contact
