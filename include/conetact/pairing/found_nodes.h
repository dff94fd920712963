// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_found_nodes_h
#define conetact_pairing_found_nodes_h

#include "conetact/base/archive.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/rigid_motion.h"

#include <vector>

namespace conetact::pairing
{
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

  /** The same of frames of bodies, whose centres stay. */
  void
  save_frames(const std::vector<RigidMotion> &frames, Archive &archive);
  void
  restore_frames(const Archive &archive, std::vector<RigidMotion> &frames);
} // namespace conetact::pairing

#endif
