// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_shared_areas_h
#define conetact_pairing_shared_areas_h

#include "conetact/pairing/contact_nodes.h"

#include <vector>

namespace conetact::pairing
{
  /**
   * Contacts of the same faces with several masters, as of a block across two
   * others: a node over the border between these, paired by itself with each,
   * has in each contact the area of its faces that see that master, as means
   * over faces have. Structures are where the nodes were found; where only
   * those that slide were found again, others have their areas already.
   */
  void
  share_areas(const std::vector<Contact>                   &contacts,
              const std::vector<const bodies::Structure *> &structures,
              const bool                                    only_sliding,
              std::vector<ContactNode>                     &nodes);
} // namespace conetact::pairing

#endif
