// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/adjusted_gaps.h"

#include "conetact/pairing/contact_facets.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace conetact::pairing
{
  namespace
  {
    /**
     * Gaps g up to a margin m are those of facets: zero. So that there is no
     * step to gaps that are drawn, beyond it they are 3/2 (|g| - m) with the
     * sign of g, which from 3 m on is g itself.
     */
    double
    without_facets(const double gap, const double margin)
    {
      constexpr double ramp = 3;
      const double     size = std::abs(gap);
      if (size <= margin || size >= ramp * margin)
        return size <= margin ? 0 : gap;
      return std::copysign(ramp * (size - margin) / (ramp - 1), gap);
    }
    /** By as much as all, but no further than its own gap: where faces are
     * plane, or less bent, its mean is less below that. */
    void
    lift_node(ContactNode &node, const double lift)
    {
      const double below = node.own_gap ? *node.own_gap - node.gap : lift;
      if (const double by = std::clamp(below, 0., lift); by > 0)
        node.growth = [by](const double) { return by; };
    }
  } // namespace

  bool
  lift_convex_faces(const Contact                                &contact,
                    const unsigned int                            number,
                    const std::vector<const bodies::Structure *> &structures,
                    std::vector<ContactNode>                     &nodes)
  {
    if (contact.kind != ContactKind::contact || contact.gap)
      return 0;
    std::optional<ContactFacets> facets; // few contacts need them
    double                       lift = 0;
    for (const ContactNode &node : nodes)
      if (node.contact == number && node.least_gap)
        if (const double below = *node.least_gap - node.gap; below > lift)
          {
            if (!facets)
              facets.emplace(contact, structures);
            // Facets of what it meets leave differences of their own.
            if (below > facet_margin * facets->around(node))
              lift = below;
          }
    if (lift > 0)
      for (ContactNode &node : nodes)
        if (node.contact == number)
          lift_node(node, lift);
    return lift > 0;
  }

  /* A gap that is adjusted stays the drawn one, and grows by the difference
     from t = 0 on: feet, arms of moments and true gaps are those of the faces.
   */
  void
  adjust_gaps(const Contact                                &contact,
              const unsigned int                            number,
              const std::vector<const bodies::Structure *> &structures,
              std::vector<ContactNode>                     &nodes)
  {
    const ContactFacets facets(contact, structures);
    const auto          margin = [&](const ContactNode &node) {
      return facet_margin * facets.around(node);
    };
    // Sides that nowhere touch are meant to be apart: their gaps are not those
    // of facets, however small.
    const bool touches =
      std::any_of(nodes.begin(), nodes.end(), [&](const ContactNode &node) {
        return node.contact == number && !node.meets_nothing() &&
               std::abs(gap_at_start(node)) <= margin(node);
      });
    for (ContactNode &node : nodes)
      if (node.contact == number)
        {
          const double start = gap_at_start(node);
          const double taken = touches && !node.meets_nothing() ?
                                 without_facets(start, margin(node)) :
                                 start;
          node.growth        = [change = taken - node.gap](const double) {
            return change;
          };
        }
  }

  double
  gap_at_start(const ContactNode &node)
  {
    return node.gap + (node.growth ? node.growth(0) : 0);
  }
} // namespace conetact::pairing
