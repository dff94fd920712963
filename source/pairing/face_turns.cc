// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/face_net.h"

#include <algorithm>
#include <cmath>

// How faces of a net turn from their neighbours, and which points may be
// nearest to them for that.

namespace conetact::pairing
{
  namespace
  {
    /** The largest angle between normals of a face and its mean one. */
    double
    warp_of(const FaceNet::Face &face)
    {
      double warp = 0;
      for (std::size_t i = 0; i < face.corners.size(); ++i)
        {
          const Tensor<1, 3> n =
            face_normal_at(face.corners, {{double(i % 2), double(i / 2)}});
          warp =
            std::max(warp, std::acos(std::min(1., std::abs(n * face.outward))));
        }
      return warp;
    }
  } // namespace

  void
  FaceNet::measure_turns()
  {
    const auto angle = [](const Tensor<1, 3> &a, const Tensor<1, 3> &b) {
      return std::acos(std::clamp(a * b, -1., 1.));
    };
    for (Face &face : faces)
      {
        // Normals near a face differ from its mean by its own warp and by the
        // turn to its neighbours: so far beside it may a point stand that it is
        // nearest to.
        double     to_others = 0;
        const auto see       = [&](const std::size_t other) {
          const Tensor<1, 3> &n = faces[other].outward;
          to_others             = std::max(to_others, angle(face.outward, n));
          if (const auto mean = bodies::smooth_patches({face.outward, n});
              mean.size() == 1)
            // Facets of one smooth surface: the true normal at their edge lies
            // between both.
            face.bend =
              std::max(face.bend,
                       cross_product_3d(face.outward, mean[0]).norm());
        };
        const std::vector<std::size_t> others = neighbours(face);
        std::for_each(others.begin(), others.end(), see);
        const double whole = to_others + 2 * warp_of(face);
        face.turn          = whole < M_PI / 2 ? std::sin(whole) : 1;
      }
  }

  /** The direction in the only other face at an edge that leads away from it; 0
   * where there are several, or where edges have parts. */
  Tensor<1, 3>
  FaceNet::beyond_edge(const std::size_t face, const std::size_t edge) const
  {
    const Edge &own = faces[face].edges[edge];
    if (own.partners.size() != 1)
      return {};
    Tensor<1, 3> beyond;
    unsigned int n_common = 0;
    for (const Edge &other : faces[own.partners[0]].edges)
      if (std::count(other.partners.begin(), other.partners.end(), face) > 0 &&
          other.middle.distance(own.middle) <= 1e-6 * faces[face].size)
        {
          beyond = -other.outward;
          ++n_common;
        }
    return n_common == 1 ? beyond : Tensor<1, 3>();
  }

  /** Unit vectors along all edges of the surface from a corner of faces. */
  std::vector<Tensor<1, 3>>
  FaceNet::edges_leaving(const unsigned int node) const
  {
    std::vector<Tensor<1, 3>> edges;
    for (const std::size_t f : faces_at_node[node])
      {
        const Face       &face = faces[f];
        const std::size_t n    = face.corners.size();
        const auto        at   = static_cast<std::size_t>(
          std::find(face.nodes.begin(), face.nodes.end(), node) -
          face.nodes.begin());
        // Corners of a quadrilateral stand at (0, 0), (1, 0), (0, 1), (1, 1).
        for (std::size_t i = 0; i < n && at < n; ++i)
          if (i != at && (n == 3 || i + at != 3))
            {
              const Tensor<1, 3> along = face.corners[i] - face.corners[at];
              edges.push_back(along / along.norm());
            }
      }
    return edges;
  }

  /* A face at an edge of 90 degrees may have feet of points in all directions,
     by `turn` alone: there each edge and corner is asked. */
  void
  FaceNet::find_flat_edges()
  {
    constexpr double  steep = .3, flat = 1e-3; // sine and angle
    std::vector<bool> is_flat;
    for (const Face &face : faces)
      is_flat.push_back(warp_of(face) < flat);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (Face &face = faces[f]; face.turn > steep && is_flat[f])
        {
          face.is_at_flat_edge = true;
          for (std::size_t e = 0; e < face.edges.size(); ++e)
            if (const auto &partners = face.edges[e].partners;
                partners.size() == 1 && is_flat[partners[0]])
              face.edges[e].beyond = beyond_edge(f, e);
          if (face.corners.size() > 2)
            for (std::size_t i = 0; i < face.corners.size(); ++i)
              face.leaving.push_back(edges_leaving(face.nodes[i]));
        }
  }

  namespace
  {
    /** What is farther than this across an edge or along it, over the distance,
     * is nearer to what is there by more than rounding. */
    constexpr double clearly = .02;
  } // namespace

  bool
  FaceNet::Face::may_have_foot_at_corner(const std::size_t i,
                                         const Point<3>   &p) const
  {
    const Tensor<1, 3> arm  = p - corners[i];
    const double       much = clearly * std::max(size, arm.norm());
    return std::none_of(leaving[i].begin(),
                        leaving[i].end(),
                        [&](const Tensor<1, 3> &edge) {
                          return arm * edge > much;
                        });
  }

  /** Tells whether the nearest point may be on an edge: p is beyond it as seen
   * from the face, and from the face on its other side as well. */
  bool
  FaceNet::Face::may_have_foot_on_edge(const Point<3> &p) const
  {
    for (const Edge &edge : edges)
      {
        const Tensor<1, 3> arm    = p - edge.middle;
        const double       much   = clearly * std::max(size, arm.norm());
        const double       length = edge.half.norm(); // to a corner
        if (arm * edge.outward >= -much && arm * edge.beyond <= much &&
            std::abs(arm * edge.half) <= length * (length + much))
          return true;
      }
    for (std::size_t i = 0; i < leaving.size(); ++i)
      if (may_have_foot_at_corner(i, p))
        return true;
    return false;
  }
} // namespace conetact::pairing
