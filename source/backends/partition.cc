// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/partition.h"

#include <algorithm>
#include <numeric>

namespace conetact::backends
{
  namespace
  {
    using Number = std::vector<int>::iterator;

    class Bisection
    {
    public:
      Bisection(const std::vector<WeighedNode> &n, std::vector<int> &p)
        : nodes(n)
        , part(p)
      {}

      void
      cut(const Number begin,
          const Number end,
          const int    first_part,
          const int    n_parts)
      {
        if (n_parts == 1 || begin == end)
          {
            for (Number i = begin; i != end; ++i)
              part[static_cast<std::size_t>(*i)] = first_part;
            return;
          }
        order(begin, end);
        const int    n_first = n_parts / 2;
        const Number middle  = find_middle(begin, end, n_first, n_parts);
        cut(begin, middle, first_part, n_first);
        cut(middle, end, first_part + n_first, n_parts - n_first);
      }

    private:
      const WeighedNode &
      node(const int i) const
      {
        return nodes[static_cast<std::size_t>(i)];
      }

      /* Planes of nodes are cut along their lines. */
      void
      order(const Number begin, const Number end) const
      {
        std::array<double, 3> low = node(*begin).position, high = low;
        for (Number i = begin; i != end; ++i)
          for (std::size_t k = 0; k < 3; ++k)
            {
              low[k]  = std::min(low[k], node(*i).position[k]);
              high[k] = std::max(high[k], node(*i).position[k]);
            }
        std::array<std::size_t, 3> axes = {{0, 1, 2}};
        std::stable_sort(axes.begin(),
                         axes.end(),
                         [&](const std::size_t a, const std::size_t b) {
                           return high[a] - low[a] > high[b] - low[b];
                         });
        std::sort(begin, end, [&](const int i, const int j) {
          for (const std::size_t k : axes)
            if (node(i).position[k] != node(j).position[k])
              return node(i).position[k] < node(j).position[k];
          return i < j;
        });
      }

      Number
      find_middle(const Number begin,
                  const Number end,
                  const int    n_first,
                  const int    n_parts) const
      {
        double all = 0, sum = 0;
        for (Number i = begin; i != end; ++i)
          all += node(*i).weight;
        Number middle = begin;
        while (middle != end && sum < all * n_first / n_parts)
          sum += node(*middle++).weight;
        const auto n_behind = n_parts - n_first;
        if (end - begin < n_parts)
          return middle;
        return std::clamp(middle, begin + n_first, end - n_behind);
      }

      const std::vector<WeighedNode> &nodes;
      std::vector<int>               &part;
    };
  } // namespace



  std::vector<int>
  partition(const std::vector<WeighedNode> &nodes, const int n_parts)
  {
    std::vector<int> part(nodes.size(), 0), order(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    if (!nodes.empty())
      Bisection(nodes, part).cut(order.begin(), order.end(), 0, n_parts);
    return part;
  }
} // namespace conetact::backends
