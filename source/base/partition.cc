// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/partition.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace conetact
{
  namespace
  {
    using Number   = std::vector<int>::iterator;
    using Position = std::array<double, 3>;

    /** What a part may have more than its share of the work, relative. */
    constexpr double near_enough = .017;

    struct Box
    {
      Position low, high;

      explicit Box(const Position &p)
        : low(p)
        , high(p)
      {}
      void
      add(const Position &p)
      {
        for (std::size_t k = 0; k < 3; ++k)
          {
            low[k]  = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
          }
      }
      double
      side(const std::size_t axis) const
      {
        return high[axis] - low[axis];
      }
      /** The longest first. */
      std::array<std::size_t, 3>
      axes() const
      {
        std::array<std::size_t, 3> axes = {{0, 1, 2}};
        std::stable_sort(axes.begin(),
                         axes.end(),
                         [&](const std::size_t a, const std::size_t b) {
                           return side(a) > side(b);
                         });
        return axes;
      }
    };

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
        const std::size_t axis    = order(begin, end);
        const int         n_first = n_parts / 2;
        const Number middle = find_middle(begin, end, axis, n_first, n_parts);
        cut(begin, middle, first_part, n_first);
        cut(middle, end, first_part + n_first, n_parts - n_first);
      }

    private:
      const WeighedNode &
      node(const int i) const
      {
        return nodes[static_cast<std::size_t>(i)];
      }

      /* Planes of nodes are cut along their lines. Returns the axis across
         which nodes are halved. */
      std::size_t
      order(const Number begin, const Number end) const
      {
        Box box(node(*begin).position);
        for (Number i = begin; i != end; ++i)
          box.add(node(*i).position);
        const auto axes = box.axes();
        std::sort(begin, end, [&](const int i, const int j) {
          for (const std::size_t k : axes)
            if (node(i).position[k] != node(j).position[k])
              return node(i).position[k] < node(j).position[k];
          return i < j;
        });
        return axes[0];
      }

      /* Between planes, if that is near enough: parts of regular meshes are
         regular, then. */
      Number
      find_middle(const Number      begin,
                  const Number      end,
                  const std::size_t axis,
                  const int         n_first,
                  const int         n_parts) const
      {
        double all = 0;
        for (Number i = begin; i != end; ++i)
          all += node(*i).weight;
        const double wanted = all * n_first / n_parts;
        double       sum = 0, nearest = near_enough * all / n_parts;
        Number       middle = begin, plane = end;
        for (Number i = begin; i != end; ++i)
          {
            if (sum < wanted)
              middle = i + 1;
            if (i != begin && std::abs(sum - wanted) < nearest &&
                node(*i).position[axis] != node(*(i - 1)).position[axis])
              {
                plane   = i;
                nearest = std::abs(sum - wanted);
              }
            sum += node(*i).weight;
          }
        if (plane != end)
          middle = plane;
        const auto n_behind = n_parts - n_first;
        if (end - begin < n_parts)
          return middle;
        return std::clamp(middle, begin + n_first, end - n_behind);
      }

      const std::vector<WeighedNode> &nodes;
      std::vector<int>               &part;
    };

    /** Nodes in the order of a curve that fills space (Hilbert): those near
     * each other are near in memory. */
    std::vector<int>
    along_curve(const std::vector<Position> &positions)
    {
      std::vector<dealii::Point<3>> points;
      for (const Position &p : positions)
        points.emplace_back(p[0], p[1], p[2]);
      constexpr int fine = 20; // halvings of the box
      const auto    places =
        dealii::Utilities::inverse_Hilbert_space_filling_curve(points, fine);
      std::vector<int> order(positions.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const int i, const int j) {
                         return places[static_cast<std::size_t>(i)] <
                                places[static_cast<std::size_t>(j)];
                       });
      return order;
    }
  } // namespace



  std::vector<int>
  partition(const std::vector<WeighedNode> &nodes, const int n_parts)
  {
    Assert(n_parts > 0, dealii::ExcMessage("Nodes need a part to be in."));
    std::vector<int> part(nodes.size(), 0), order(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    if (!nodes.empty())
      Bisection(nodes, part).cut(order.begin(), order.end(), 0, n_parts);
    return part;
  }



  /* Lines along the longest side; those of planes through it and the shortest
     one follow each other, so that neighbours are near. */
  std::vector<int>
  order_of_lines(const std::vector<Position> &positions)
  {
    std::vector<int> lines(positions.size());
    std::iota(lines.begin(), lines.end(), 0);
    if (positions.empty())
      return lines;
    Box box(positions.front());
    for (const Position &p : positions)
      box.add(p);
    const auto [along, plane, line] = box.axes();
    const double same = 1e-6 * box.side(along); // but for rounding
    struct Place
    {
      double plane, line, along;
    };
    std::vector<Place> places;
    for (const Position &p : positions)
      places.push_back({std::round((p[plane] - box.low[plane]) / same),
                        std::round((p[line] - box.low[line]) / same),
                        p[along]});
    const auto place = [&](const int i) -> const Place & {
      return places[static_cast<std::size_t>(i)];
    };
    std::sort(lines.begin(), lines.end(), [&](const int i, const int j) {
      const Place &a = place(i), &b = place(j);
      return std::tie(a.plane, a.line, a.along, i) <
             std::tie(b.plane, b.line, b.along, j);
    });
    std::size_t n_followers = 0;
    for (std::size_t k = 1; k < lines.size(); ++k)
      if (place(lines[k]).plane == place(lines[k - 1]).plane &&
          place(lines[k]).line == place(lines[k - 1]).line)
        ++n_followers;
    return 2 * n_followers > lines.size() ? lines : along_curve(positions);
  }
} // namespace conetact
