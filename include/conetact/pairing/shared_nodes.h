// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_shared_nodes_h
#define conetact_pairing_shared_nodes_h

#include "conetact/pairing/contact_nodes.h"

#include <vector>

namespace conetact::pairing
{
  /**
   * Makes one of nodes that two contacts share at a seam, as where a face from
   * CAD is split: the same node of a body, against the same master, along
   * normals that differ by less than a sharp edge. Two rows for it would leave
   * open which of them carries what. It becomes what one contact with the faces
   * of both would have, with means over the areas of both, of friction
   * coefficients, too, and is a node of the first of them.
   */
  void
  unite_shared(const std::vector<Contact> &contacts,
               const unsigned int          dim,
               std::vector<ContactNode>   &nodes);

  /** Nodes of a contact that face its master and belong to earlier contacts. */
  unsigned int
  n_shared(const unsigned int              contact,
           const unsigned int              n_paired,
           const std::vector<ContactNode> &nodes);
} // namespace conetact::pairing

#endif
