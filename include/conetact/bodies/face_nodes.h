// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_face_nodes_h
#define conetact_bodies_face_nodes_h

#include "conetact/bodies/structure.h"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace conetact::bodies
{
  /**
   * Which nodes of a face are its corners, between which edges are straight.
   * Where displacements are of second degree, those in the middle of edges and
   * of the face stand behind them: three nodes of a segment (in the plane only,
   * in space they are a triangle), nine of a quadrilateral.
   */
  std::size_t
  n_corners(const Structure &body, const SurfaceFace &face);

  inline bool
  is_of_second_degree(const Structure &body, const SurfaceFace &face)
  {
    return face.nodes.size() > n_corners(body, face);
  }

  /** A node of a face of second degree that is no corner, and the corners that
   * it is in the middle of, by their places in the face. */
  struct MiddleNode
  {
    std::size_t              node;
    std::vector<std::size_t> corners;
  };
  /** Of faces with so many nodes, lines in the plane; none of first degree. */
  const std::vector<MiddleNode> &
  middle_nodes(const unsigned int dim, const std::size_t n_nodes);
  /** Of a face, by their numbers. */
  std::vector<HangingNode>
  middle_nodes(const Structure &body, const SurfaceFace &face);

  /** Whether a node of a face stands beside the mean of the corners that it is
   * in the middle of, by more than this; `at(i)` is the place of its i-th one.
   */
  template <typename PlaceOf>
  bool
  is_bent(const unsigned int dim,
          const std::size_t  n_nodes,
          const PlaceOf     &at,
          const double       more)
  {
    const std::vector<MiddleNode> &middles = middle_nodes(dim, n_nodes);
    return std::any_of(middles.begin(),
                       middles.end(),
                       [&](const MiddleNode &middle) {
                         std::decay_t<decltype(at(0) - at(0))> beside;
                         for (const std::size_t corner : middle.corners)
                           beside += (at(middle.node) - at(corner)) /
                                     static_cast<double>(middle.corners.size());
                         return beside.norm() > more;
                       });
  }

  /** Faces of first degree over all nodes: itself, or two or four. */
  std::vector<std::vector<unsigned int>>
  parts_of_first_degree(const Structure &body, const SurfaceFace &face);

  /** Of these the ones between the nodes that contacts stand at. */
  std::vector<std::vector<unsigned int>>
  parts_of_contacts(const Structure &body, const SurfaceFace &face);
} // namespace conetact::bodies

#endif
