// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_pair_spring_h
#define conetact_pairing_pair_spring_h

#include "conetact/pairing/contact_nodes.h"

namespace conetact::pairing
{
  /** What a spring meets that has no other end. */
  const Obstacle &
  ground();

  /** Both points of a spring, as one contact node without friction. Throws
   * InputError where a body does not hold its point. */
  PairedNodes
  pair_spring(const Contact                                &contact,
              const std::vector<const bodies::Structure *> &structures);
} // namespace conetact::pairing

#endif
