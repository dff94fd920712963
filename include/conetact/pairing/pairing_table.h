// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_pairing_table_h
#define conetact_pairing_pairing_table_h

#include "conetact/pairing/contact_nodes.h"

#include <string>
#include <vector>

namespace conetact
{
  /** A way to find what the nodes of a contact may touch. */
  struct PairingRow
  {
    std::string name, description;
    PairedNodes (*pair)(const Contact                        &contact,
                        const std::vector<const Structure *> &structures);
    bool takes_means; ///< over faces; else each node by itself
  };

  /** What `Pairing` in a contact may be; the first one is the default. */
  const std::vector<PairingRow> &
  pairings();

  /**
   * How a contact is paired: as it says, but nodes that meet an obstacle, and
   * surfaces without faces or with two sides, one by one.
   */
  const PairingRow &
  pairing_of(const Contact                        &contact,
             const std::vector<const Structure *> &structures);
} // namespace conetact

#endif
