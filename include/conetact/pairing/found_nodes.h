// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_found_nodes_h
#define conetact_pairing_found_nodes_h

#include "conetact/base/archive.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/rigid_motion.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace conetact::pairing
{
  /** Why nodes of a contact do not find their places again where bodies are
   * displaced, a sentence without its stop. */
  std::string
  why_not_found(const Contact                                &contact,
                const std::vector<const bodies::Structure *> &structures,
                const std::vector<const bodies::Structure *> &displaced);

  /** Keeps what contact nodes have found where bodies are displaced. */
  void
  save_found(const std::vector<ContactNode> &nodes, Archive &archive);
  /**
   * Gives the nodes of bodies, as they are at the start, what was kept of
   * them. Throws InputError where they are others.
   */
  void
  restore_found(const Archive                                &archive,
                const std::vector<const bodies::Structure *> &structures,
                std::vector<ContactNode>                     &nodes);

  /** By which face of the other body a node of one came in, see
   * SlidingContacts::passages(): contact, body, node. */
  using Entries = std::map<std::array<unsigned int, 3>, unsigned int>;
  /** The same of entries, of contacts that have these nodes. */
  void
  save_entries(const Entries &inside, Archive &archive);
  Entries
  restore_entries(const Archive                                &archive,
                  const std::vector<const bodies::Structure *> &structures,
                  const std::vector<ContactNode>               &nodes);

  /** The same of frames of bodies, whose centres stay. */
  void
  save_frames(const std::vector<RigidMotion> &frames, Archive &archive);
  void
  restore_frames(const Archive &archive, std::vector<RigidMotion> &frames);
} // namespace conetact::pairing

#endif
