// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_spacings_h
#define conetact_pairing_spacings_h

#include "conetact/bodies/structure.h"

#include <map>

namespace conetact::pairing
{
  /** The longest edge of the faces at each node of a surface [length]. */
  std::map<unsigned int, double>
  spacings(const bodies::Surface &surface, const bodies::Structure &body);
} // namespace conetact::pairing

#endif
