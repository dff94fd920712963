// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/cell_topology.h"

#include <deal.II/base/exceptions.h>

namespace conetact
{
  const CellTopology &
  topology_of(const unsigned int dim, const std::size_t n_corners)
  {
    static const std::map<std::pair<unsigned int, std::size_t>, CellTopology>
               all   = {{{1, 2}, {{{0, 1}}, {}, {}}},
                        {{2, 3}, {{{0, 1}, {1, 2}, {2, 0}}, {}, {{0, 1, 2}}}},
                        {{2, 4}, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {{0, 1, 2, 3}}, {}}},
                        {{3, 4},
                         {{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}},
                          {},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}},
                        {{3, 5},
                         {{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}},
                          {{0, 3, 2, 1}},
                          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}},
                        {{3, 6},
                         {{{0, 1},
                           {0, 2},
                           {0, 3},
                           {1, 2},
                           {1, 4},
                           {2, 5},
                           {3, 4},
                           {3, 5},
                           {4, 5}},
                          {{0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}},
                          {{0, 2, 1}, {3, 4, 5}}}},
                        {{3, 8},
                         {{{0, 1},
                           {0, 3},
                           {0, 4},
                           {1, 2},
                           {1, 5},
                           {2, 3},
                           {2, 6},
                           {3, 7},
                           {4, 5},
                           {4, 7},
                           {5, 6},
                           {6, 7}},
                          {{0, 3, 2, 1},
                           {0, 1, 5, 4},
                           {0, 4, 7, 3},
                           {1, 2, 6, 5},
                           {2, 3, 7, 6},
                           {4, 5, 6, 7}},
                          {}}}};
    const auto found = all.find({dim, n_corners});
    Assert(found != all.end(), dealii::ExcMessage("No such kind of element."));
    return found->second;
  }
} // namespace conetact
