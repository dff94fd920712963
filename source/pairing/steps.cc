// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    /** Over the size of a face: sides that are further apart than this are not
     * flush. */
    constexpr double flush = 5e-3;

    /** Faces of the master in sight, those that have a node in common as one.
     */
    class InSight
    {
    public:
      InSight(const std::vector<FaceNet::Face>             &master,
              const std::vector<const FacingParts::Part *> &parts)
      {
        std::map<unsigned int, std::size_t> face_at; // of nodes
        for (const FacingParts::Part *const part : parts)
          {
            first.emplace(part->face, part->face);
            for (const unsigned int node : master[part->face].nodes)
              join(part->face, face_at.emplace(node, part->face).first->second);
          }
        for (const FacingParts::Part *const part : parts)
          {
            const std::size_t one    = first_of(part->face);
            const auto [low, is_new] = lowest.emplace(one, part->gap);
            low->second              = std::min(low->second, part->gap);
            if (std::abs(part->gap) < std::abs(nearest))
              {
                nearest    = part->gap;
                nearest_of = one;
              }
          }
      }

      /** Whether a face belongs to a side that is behind the nearest one. */
      bool
      is_behind(const std::size_t face, const double size) const
      {
        const std::size_t one = first_of(face);
        return one != nearest_of &&
               lowest.at(one) > lowest.at(nearest_of) + flush * size;
      }

    private:
      std::size_t
      first_of(std::size_t face) const
      {
        while (first.at(face) != face)
          face = first.at(face);
        return face;
      }
      void
      join(const std::size_t one, const std::size_t other)
      {
        const std::size_t a = first_of(one), b = first_of(other);
        first[std::max(a, b)] = std::min(a, b);
      }

      std::map<std::size_t, std::size_t> first; ///< of faces, in sets
      std::map<std::size_t, double>      lowest;
      double      nearest    = std::numeric_limits<double>::max();
      std::size_t nearest_of = 0;
    };

    /** Faces of a surface that have a node in common with one of them. */
    std::vector<std::vector<std::size_t>>
    neighbours_of(const std::vector<FaceNet::Face> &faces)
    {
      std::map<unsigned int, std::vector<std::size_t>> at_node;
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (const unsigned int node : faces[f].nodes)
          at_node[node].push_back(f);
      std::vector<std::vector<std::size_t>> neighbours(faces.size());
      for (std::size_t f = 0; f < faces.size(); ++f)
        {
          std::vector<std::size_t> &all = neighbours[f];
          for (const unsigned int node : faces[f].nodes)
            all.insert(all.end(), at_node[node].begin(), at_node[node].end());
          std::sort(all.begin(), all.end());
          all.erase(std::unique(all.begin(), all.end()), all.end());
        }
      return neighbours;
    }

    std::vector<const FacingParts::Part *>
    parts_of(const std::vector<std::size_t> &faces, const SeenParts &seen)
    {
      std::vector<const FacingParts::Part *> parts;
      for (const std::size_t f : faces)
        for (const FacingParts::Part &part : seen[f])
          parts.push_back(&part);
      return parts;
    }

    bool
    are_flush(const std::vector<const FacingParts::Part *> &parts,
              const double                                  size)
    {
      const auto less = [](const FacingParts::Part *a,
                           const FacingParts::Part *b) {
        return a->gap < b->gap;
      };
      const auto [low, high] =
        std::minmax_element(parts.begin(), parts.end(), less);
      return low == parts.end() || (*high)->gap - (*low)->gap <= flush * size;
    }
  } // namespace

  void
  leave_out_steps(const std::vector<FaceNet::Face> &slave,
                  const std::vector<FaceNet::Face> &master,
                  SeenParts                        &seen)
  {
    std::vector<std::pair<std::size_t, std::vector<std::size_t>>> behind;
    const auto neighbours = neighbours_of(slave);
    for (std::size_t f = 0; f < slave.size(); ++f)
      {
        const double size  = slave[f].size;
        const auto   parts = parts_of(neighbours[f], seen);
        if (seen[f].empty() || are_flush(parts, size))
          continue;
        const InSight            sides(master, parts);
        std::vector<std::size_t> left_out;
        for (std::size_t i = 0; i < seen[f].size(); ++i)
          if (sides.is_behind(seen[f][i].face, size))
            left_out.push_back(i);
        if (!left_out.empty())
          behind.emplace_back(f, std::move(left_out));
      }
    for (const auto &[f, left_out] : behind)
      for (auto i = left_out.rbegin(); i != left_out.rend(); ++i)
        seen[f].erase(seen[f].begin() + static_cast<std::ptrdiff_t>(*i));
  }
} // namespace conetact::pairing
