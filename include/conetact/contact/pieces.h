// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_pieces_h
#define conetact_contact_pieces_h

#include "conetact/bodies/structure.h"

namespace conetact::contact
{
  /** How many parts of a body no element joins. */
  unsigned int
  n_pieces(const bodies::Structure &structure);
} // namespace conetact::contact

#endif
