// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/joined_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    /** Points further apart than this part of the size of a surface are never
     * joined, but for the rounding of their coordinates. */
    constexpr double largest_distance = 1e-5;
    /** Points that are one may differ by this part of the largest coordinate in
     * a file of single precision. */
    constexpr double single_precision = 5e-7;

    /** Numbers points; those within a distance of the first one are one. */
    class Points
    {
    public:
      explicit Points(const double d)
        : distance(d)
      {}

      unsigned int
      number(const Point<3> &p)
      {
        // Boxes are as wide as the distance: what is near p is in its box or in
        // one of the 26 around it.
        const Box own = box(p);
        for (unsigned int i = 0; i < (distance > 0 ? 27u : 1u); ++i)
          {
            Box near = own;
            if (distance > 0)
              near = {{own[0] + i % 3 - 1.,
                       own[1] + (i / 3) % 3 - 1.,
                       own[2] + static_cast<double>(i / 9) - 1.}};
            const auto [begin, end] = known.equal_range(near);
            for (auto found = begin; found != end; ++found)
              if (all[found->second].distance(p) <= distance)
                return found->second;
          }
        known.emplace(own, static_cast<unsigned int>(all.size()));
        all.push_back(p);
        return static_cast<unsigned int>(all.size() - 1);
      }

      std::vector<Point<3>> all;

    private:
      using Box = std::array<double, 3>;
      Box
      box(const Point<3> &p) const
      {
        if (distance == 0)
          return {{p[0] + 0., p[1] + 0., p[2] + 0.}}; // + 0. makes -0 a 0
        return {{std::floor(p[0] / distance),
                 std::floor(p[1] / distance),
                 std::floor(p[2] / distance)}};
      }

      double                           distance;
      std::multimap<Box, unsigned int> known;
    };

    SurfaceFaces
    joined_within(const SurfaceFaces &mesh, const double distance)
    {
      SurfaceFaces              result;
      Points                    points(distance);
      std::vector<unsigned int> number_of;
      for (const Point<3> &p : mesh.points)
        number_of.push_back(points.number(p));
      for (const std::vector<unsigned int> &face : mesh.faces)
        {
          std::vector<unsigned int> corners;
          for (const unsigned int i : face)
            if (std::find(corners.begin(), corners.end(), number_of[i]) ==
                corners.end())
              corners.push_back(number_of[i]);
          // Faces whose corners have become one or two points are slivers, and
          // go.
          if (corners.size() >= std::min<std::size_t>(face.size(), 3))
            result.faces.push_back(corners);
        }
      result.points = std::move(points.all);
      return result;
    }

    /** Tells whether each edge of a face is that of one other face, which runs
     * the other way; of lines, whether one begins where another ends. */
    bool
    is_closed(const SurfaceFaces &mesh)
    {
      using Ends = std::pair<unsigned int, unsigned int>;
      std::map<Ends, int> edges;
      std::map<Ends, int> ends; // of lines
      for (const auto &face : mesh.faces)
        if (face.size() == 2)
          {
            ++ends[{face[0], 0}];
            ++ends[{face[1], 1}];
          }
        else
          for (std::size_t i = 0; i < face.size(); ++i)
            ++edges[{face[i], face[(i + 1) % face.size()]}];
      const auto is_matched = [](const std::map<Ends, int> &all,
                                 const auto                &match) {
        return std::all_of(all.begin(), all.end(), [&](const auto &edge) {
          const auto other = all.find(match(edge.first));
          return edge.second == 1 && other != all.end() && other->second == 1;
        });
      };
      return is_matched(edges,
                        [](const Ends &e) {
                          return Ends(e.second, e.first);
                        }) &&
             is_matched(ends, [](const Ends &e) {
               return Ends(e.first, 1 - e.second);
             });
    }

    /** Tells whether an edge is so short that its ends are meant to be one
     * point. */
    bool
    has_lost_edge(const SurfaceFaces &mesh, const double size)
    {
      constexpr double rounding = 1e-12;
      for (const auto &face : mesh.faces)
        for (std::size_t i = 0; i < face.size(); ++i)
          if (mesh.points[face[i]].distance(
                mesh.points[face[(i + 1) % face.size()]]) <= rounding * size)
            return true;
      return false;
    }
  } // namespace

  SurfaceFaces
  joined(const SurfaceFaces &mesh)
  {
    constexpr double step = 4, first = 1e-15;

    SurfaceFaces exact = joined_within(mesh, 0);
    if (exact.faces.empty())
      return exact;
    double size = 0, reach = 0;
    for (const Point<3> &p : exact.points)
      {
        size  = std::max(size, p.distance(exact.points.front()));
        reach = std::max(reach, p.norm());
      }
    if (is_closed(exact) && !has_lost_edge(exact, reach))
      return exact;
    // The least distance that closes the surface is taken: files write each
    // point once for each of its faces, with a rounding that nobody tells, and
    // a larger distance would join what is apart.
    const double last = largest_distance * size + single_precision * reach;
    for (double d = first * reach; d <= last; d *= step)
      if (SurfaceFaces mended = joined_within(mesh, d);
          !mended.faces.empty() && is_closed(mended) &&
          !has_lost_edge(mended, reach))
        return mended;
    return exact;
  }
} // namespace conetact::pairing
