// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_corners_to_faces_h
#define conetact_pairing_corners_to_faces_h

#include "conetact/pairing/contact_nodes.h"

#include <vector>

namespace conetact::pairing
{
  /**
   * Node to face of a slave whose contacts stand at corners
   * (SurfaceFace::meets_at_corners): each node, those in the middle of edges as
   * well, meets the point of the master's faces that is nearest, and what a
   * corner has is the mean of these pairs with the weights that it has against
   * obstacles (corner_parts.h). So a uniform pressure passes where the master's
   * shape functions are of second degree, or less, over each slave face: on
   * meshes that match, or where the slave's divides the master's. On others it
   * passes in the mean, as with nodes of first degree.
   *
   * Nodes beside the master have no part; a corner beside it has no row.
   */
  PairedNodes
  pair_corners_with_faces(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures);
} // namespace conetact::pairing

#endif
