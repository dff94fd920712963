// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/halo.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::iterative
{
  /* Owners are told once which of their blocks others need. In each product all
     know then what to send and how much will come: neither numbers nor lengths
     are sent again. */
  HaloPlan::HaloPlan(const std::vector<int> &needed,
                     const std::vector<int> &first,
                     const Communicator     &processes)
    : n_needed(static_cast<int>(needed.size()))
    , comm(processes.handle())
  {
    AssertDimension(first.size(),
                    static_cast<std::size_t>(processes.size()) + 1);
    Assert(std::is_sorted(needed.begin(), needed.end()),
           dealii::ExcMessage("Blocks of others are ascending."));
    Assert(needed.empty() ||
             (needed.front() >= 0 && needed.back() < first.back()),
           dealii::ExcMessage("Some process has each block."));
    const auto own = static_cast<std::size_t>(processes.rank());
    const auto n   = static_cast<std::size_t>(processes.size());
    std::vector<std::vector<int>> asked(n);
    std::size_t                   owner = 0;
    for (const int i : needed)
      {
        while (i >= first[owner + 1])
          ++owner;
        asked[owner].push_back(i - first[owner]);
      }
    const std::vector<std::vector<int>> wanted = processes.exchange(asked);
    int                                 place  = 0;
    for (std::size_t p = 0; p < n; ++p)
      {
        const int length = static_cast<int>(asked[p].size());
        if (p != own && length + wanted[p].size() > 0)
          sides.push_back({static_cast<int>(p), wanted[p], place, length});
        place += length;
      }
    std::uint64_t &ghosts = traffic().ghosts;
    ghosts                = std::max<std::uint64_t>(ghosts, needed.size());
  }
} // namespace conetact::iterative
