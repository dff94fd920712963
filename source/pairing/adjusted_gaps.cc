// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/adjusted_gaps.h"

#include "conetact/pairing/contact_facets.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  void
  adjust_gaps(const Contact                                &contact,
              const unsigned int                            number,
              const std::vector<const bodies::Structure *> &structures,
              std::vector<ContactNode>                     &nodes)
  {
    const ContactFacets facets(contact, structures);
    for (ContactNode &node : nodes)
      if (node.contact == number)
        {
          const bool touches =
            !node.meets_nothing() &&
            std::abs(node.gap) <= facet_margin * facets.around(node);
          const double change = touches ? -node.gap : 0;
          node.growth         = [change](const double) { return change; };
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
