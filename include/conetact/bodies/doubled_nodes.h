// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_doubled_nodes_h
#define conetact_bodies_doubled_nodes_h

#include "conetact/bodies/structure.h"

#include <utility>
#include <vector>

namespace conetact::bodies
{
  /**
   * Pairs of nodes on the boundary of a body that are at one place, to a
   * millionth of its shortest boundary edge, and are not joined: a mesh file
   * may hold the parts of a body that way. Frames, whose members cross, have
   * none.
   */
  std::vector<std::pair<unsigned int, unsigned int>>
  doubled_nodes(const Structure &body);
} // namespace conetact::bodies

#endif
