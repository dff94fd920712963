// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/adjusted_gaps.h"

#include "conetact/pairing/contact_facets.h"

#include <algorithm>
#include <cmath>

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
  } // namespace

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
               std::abs(node.gap) <= margin(node);
      });
    for (ContactNode &node : nodes)
      if (node.contact == number)
        {
          const double change =
            touches && !node.meets_nothing() ?
              without_facets(node.gap, margin(node)) - node.gap :
              0;
          node.growth = [change](const double) { return change; };
        }
  }

  bool
  is_adjusted(const unsigned int contact, const std::vector<ContactNode> &nodes)
  {
    return std::any_of(nodes.begin(),
                       nodes.end(),
                       [contact](const ContactNode &node) {
                         return node.contact == contact && node.growth;
                       });
  }

  double
  gap_at_start(const ContactNode &node)
  {
    return node.gap + (node.growth ? node.growth(0) : 0);
  }
} // namespace conetact::pairing
