// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_face_to_node_h
#define conetact_pairing_face_to_node_h

#include "conetact/pairing/contact_nodes.h"

namespace conetact::pairing
{
  /**
   * Each node of the master meets the nearest point of the body's faces: a
   * mean over the nodes of the face that holds it (ContactNode::slaves).
   */
  PairedNodes
  pair_faces_with_nodes(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures);
} // namespace conetact::pairing

#endif
