// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_overlap_h
#define conetact_pairing_overlap_h

#include "conetact/bodies/structure.h"

#include <optional>

namespace conetact::pairing
{
  /** A node of one body that is inside of another one. */
  struct Overlap
  {
    Point<3> position;
    double   depth = 0; ///< to the nearest face [length]
    double   edge  = 0; ///< longest of that face [length]
  };

  /**
   * The node of `body` that is deepest inside of `other`, both where they stand
   * now; none: they do not overlap. Bodies without an inside, which are frames,
   * overlap nothing. Planes of symmetry and other sides count as faces.
   */
  std::optional<Overlap>
  deepest_inside(const bodies::Structure &body, const bodies::Structure &other);
} // namespace conetact::pairing

#endif
