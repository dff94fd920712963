// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_joined_surface_h
#define conetact_pairing_joined_surface_h

#include "conetact/pairing/surface_words.h"

namespace conetact::pairing
{
  /**
   * The faces with one point where several are equal; faces that fall together
   * are left out. Where the surface is open because corners differ in their
   * last digits from face to face, points are joined within the least distance
   * that closes it, at most a hundred thousandth of its size: so short edges
   * and thin faces stay. A surface that no such distance closes is joined where
   * points are equal only.
   */
  SurfaceFaces
  joined(const SurfaceFaces &mesh);
} // namespace conetact::pairing

#endif
