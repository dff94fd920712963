// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/pieces.h"

#include <numeric>
#include <vector>

namespace conetact::contact
{
  /* Sets of joined nodes as trees, whose roots stand for them (union and find):
     each element that joins two of them makes one piece less. Paths are halved
     as they are walked. */
  unsigned int
  n_pieces(const bodies::Structure &structure)
  {
    std::vector<unsigned int> parent(structure.n_nodes());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](unsigned int node) {
      while (parent[node] != node)
        node = parent[node] = parent[parent[node]];
      return node;
    };
    auto               n   = static_cast<unsigned int>(parent.size());
    const unsigned int n_c = structure.n_components();
    structure.elements().for_each_connection(
      [&](const std::vector<unsigned int> &dofs) {
        // All nodes of an element are in one piece.
        const unsigned int first = root(dofs.front() / n_c);
        for (const unsigned int dof : dofs)
          if (const unsigned int other = root(dof / n_c); other != first)
            {
              parent[other] = first;
              --n;
            }
      });
    return n;
  }
} // namespace conetact::contact
