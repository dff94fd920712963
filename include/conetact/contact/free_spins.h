// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_free_spins_h
#define conetact_contact_free_spins_h

#include "conetact/bodies/loads.h"
#include "conetact/model/bodies.h"

#include <vector>

namespace conetact::contact
{
  /**
   * Round sides of bodies that may spin: nothing holds them but contacts
   * without friction with other bodies, all about one axis, and their loads,
   * at some of the times, have no moment about it. A smooth pin in a lug, or a
   * roller between rings, may turn by any amount; facets would resist that, and
   * ask for a balance of moments that their bodies do not have.
   */
  std::vector<model::RoundSide>
  find_free_spins(const std::vector<pairing::Contact> &contacts,
                  const std::vector<bodies::Load>     &loads,
                  const std::vector<double>           &times,
                  const model::Bodies                 &bodies);

  /** Gives contacts of such sides the normals of the round surfaces, through
   * the axis, where frames have taken it: their forces do not turn the body.
   * Opposite to a plane they have its normal. */
  void
  point_to_axes(const model::Bodies               &bodies,
                std::vector<pairing::ContactNode> &nodes);
} // namespace conetact::contact

#endif
