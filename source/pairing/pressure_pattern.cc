// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/pressure_pattern.h"

#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/closest_point.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    double
    at(const PressurePattern::Pressures &pressures, const unsigned int node)
    {
      const auto found = pressures.find(node);
      return found == pressures.end() ? 0. : found->second;
    }
  } // namespace

  PressurePattern::PressurePattern(const bodies::Structure   &body,
                                   const bodies::BoundaryIds &ids)
  {
    for (const bodies::SurfaceFace &face : body.surface(ids).faces)
      for (const auto &corners : bodies::parts_of_contacts(body, face))
        {
          plane = corners.size() == 2;
          for (const unsigned int node : corners)
            {
              ++neighbours[node].n_faces;
              neighbours[node].sum += face.normal;
              positions[node] = body.position(node);
            }
          for_each_edge(corners.size(),
                        [&](const std::size_t i, const std::size_t j) {
                          add_edge(corners[i], corners[j]);
                          add_edge(corners[j], corners[i]);
                        });
        }
  }

  /* What comes a second time is an edge of two faces. */
  void
  PressurePattern::add_edge(const unsigned int one, const unsigned int other)
  {
    Around &around = neighbours[one];
    if (around.nodes.insert(other).second)
      around.rim.insert(other);
    else
      around.rim.erase(other);
  }

  /* Nodes in the middle have as many faces as edges around them, those at the
     rim one edge more. */
  bool
  PressurePattern::is_inside(const Around &around) const
  {
    return plane ? around.n_faces == 2 : around.n_faces == around.nodes.size();
  }

  /** Looks for two neighbours about opposite to each other, between which a
   * node is pressed clearly less than either. */
  bool
  PressurePattern::is_pit(const unsigned int node,
                          const double       own,
                          const Pressures   &pressures) const
  {
    // A node in a pit has less than this part of the pressure of both. Meshes
    // of a face in space have no lines of nodes: more may be by chance there.
    const double     deep     = plane ? .6 : .4;
    constexpr double opposite = -.7; // cosine
    // Inner edges of a ring are concave: nodes on both sides of one may well
    // press where the edge stands over a bore.
    const Around &own_edges = neighbours.at(node);
    const bool    is_at_rim = !plane && !is_inside(own_edges);
    const auto   &around    = is_at_rim ? own_edges.rim : own_edges.nodes;
    for (const unsigned int one : around)
      for (const unsigned int other : around)
        if (one < other &&
            own < deep * std::min(at(pressures, one), at(pressures, other)))
          {
            const Tensor<1, 3> a = positions.at(one) - positions.at(node);
            const Tensor<1, 3> b = positions.at(other) - positions.at(node);
            if (a * b < opposite * a.norm() * b.norm())
              return true;
          }
    return false;
  }

  unsigned int
  PressurePattern::n_pits(const Pressures &pressures) const
  {
    return static_cast<unsigned int>(std::count_if(
      neighbours.begin(), neighbours.end(), [&](const auto &entry) {
        return is_pit(entry.first, at(pressures, entry.first), pressures);
      }));
  }

  /* Whether no pressed node has only pressed neighbours: the area of contact is
     one or two nodes wide, and meshes do not resolve it. */
  bool
  PressurePattern::is_thin(const Pressures &pressures) const
  {
    return !neighbours.empty() &&
           std::none_of(pressures.begin(),
                        pressures.end(),
                        [&](const auto &entry) {
                          const auto found = neighbours.find(entry.first);
                          return found == neighbours.end() ||
                                 std::all_of(found->second.nodes.begin(),
                                             found->second.nodes.end(),
                                             [&](const unsigned int other) {
                                               return at(pressures, other) > 0;
                                             });
                        });
  }

  bool
  PressurePattern::is_bent() const
  {
    constexpr double parallel = 1 - 1e-5; // cosine of a quarter degree
    const double     sharp    = std::cos(bodies::angle_of_patches);
    return std::any_of(
      neighbours.begin(), neighbours.end(), [&](const auto &entry) {
        const Tensor<1, 3> &own = entry.second.sum;
        return std::any_of(entry.second.nodes.begin(),
                           entry.second.nodes.end(),
                           [&](const unsigned int node) {
                             const Tensor<1, 3> &other =
                               neighbours.at(node).sum;
                             const double cosine =
                               own * other / (own.norm() * other.norm());
                             return cosine < parallel && cosine > sharp;
                           });
      });
  }

  /* Nodes inside of a smooth surface that press while none of their neighbours
     does, though these could: what facets of two curved surfaces do that do not
     match. */
  std::vector<unsigned int>
  PressurePattern::lonely(const Pressures              &pressures,
                          const std::set<unsigned int> &could_press) const
  {
    constexpr double          smooth = .99; // cosine
    std::vector<unsigned int> result;
    for (const auto &[node, pressure] : pressures)
      {
        const auto found = neighbours.find(node);
        if (found == neighbours.end() || !is_inside(found->second))
          continue;
        const Around &around = found->second;
        // Where faces turn around a node, as at a tip, it may well press alone.
        if (around.sum.norm() >= smooth * around.n_faces &&
            std::all_of(around.nodes.begin(),
                        around.nodes.end(),
                        [&](const unsigned int other) {
                          return could_press.count(other) > 0 &&
                                 at(pressures, other) == 0;
                        }))
          result.push_back(node);
      }
    return result;
  }
} // namespace conetact::pairing
