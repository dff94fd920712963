// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_flatness_h
#define conetact_pairing_flatness_h

#include "conetact/pairing/contact_nodes.h"

#include <string>
#include <vector>

namespace conetact::pairing
{
  /**
   * Why the two sides of a contact do not meet in planes, as a part of a
   * sentence; empty: they do, and normals stay as they are wherever nodes move
   * along them. Only faces that face each other count. `nodes` are those of all
   * contacts, undeformed. Edges between planes are none of a curve.
   */
  std::string
  why_not_plane(const Contact                                &contact,
                const unsigned int                            number,
                const std::vector<ContactNode>               &nodes,
                const std::vector<const bodies::Structure *> &structures,
                const unsigned int                            dim);
} // namespace conetact::pairing

#endif
