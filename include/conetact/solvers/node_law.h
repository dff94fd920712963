// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_node_law_h
#define conetact_solvers_node_law_h

#include "conetact/solvers/cone.h"

namespace conetact::solvers
{
  /**
   * Linearised law of one node, @f$P_i \delta p_i + D_i \delta d_i = h_i@f$;
   * sizes are those of the node.
   */
  struct NodeLaw
  {
    SmallMatrix p, d;
    SmallVector h;
  };
} // namespace conetact::solvers

#endif
