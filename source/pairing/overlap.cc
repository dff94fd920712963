// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/overlap.h"

#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/closest_point.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <vector>

namespace conetact::pairing
{
  namespace
  {
    using Box     = dealii::BoundingBox<3>;
    using Corners = std::vector<Point<3>>; // of a segment or a triangle

    /**
     * A direction that no mesh has: rays along axes would run through edges and
     * nodes, where a crossing is counted twice or not at all. In the plane its
     * last part is left out.
     */
    const Tensor<1, 3> odd_direction({.5773, .6118, .5407});

    std::vector<Corners>
    simple_faces(const bodies::Structure &body)
    {
      std::vector<Corners> faces;
      const auto           add = [&](const std::vector<unsigned int> &nodes,
                           const std::vector<std::size_t>  &which) {
        faces.emplace_back();
        for (const std::size_t i : which)
          faces.back().push_back(body.position(nodes[i]));
      };
      const bodies::Surface surface = body.surface(body.boundary_ids());
      if (surface.two_sided)
        return faces;
      for (const bodies::SurfaceFace &face : surface.faces)
        for (const auto &part : bodies::parts_of_first_degree(body, face))
          if (part.size() < 4)
            add(part,
                part.size() == 2 ? std::vector<std::size_t>{0, 1} :
                                   std::vector<std::size_t>{0, 1, 2});
          else // deal.II's order
            {
              add(part, {0, 1, 2});
              add(part, {1, 3, 2});
            }
      return faces;
    }

    /** Tells whether the ray from p in the odd direction meets a segment. */
    bool
    meets_segment(const Point<3> &p, const Corners &face)
    {
      const Tensor<1, 3> a = face[0] - p, b = face[1] - p;
      const auto         side = [](const Tensor<1, 3> &v) {
        return odd_direction[0] * v[1] - odd_direction[1] * v[0];
      };
      const double s = side(a), t = side(b);
      if ((s > 0) == (t > 0))
        return false;
      const Tensor<1, 3> meet = a + s / (s - t) * (b - a);
      return meet[0] * odd_direction[0] + meet[1] * odd_direction[1] > 0;
    }

    /** Tells whether the ray from p in the odd direction meets a triangle
     * (Moller and Trumbore, J. Graphics Tools 2 (1997) 21-28). */
    bool
    meets_triangle(const Point<3> &p, const Corners &face)
    {
      const Tensor<1, 3> e = face[1] - face[0], f = face[2] - face[0];
      const Tensor<1, 3> q = dealii::cross_product_3d(odd_direction, f);
      const double       d = e * q;
      if (d == 0)
        return false;
      const Tensor<1, 3> to = p - face[0];
      const double       u  = to * q / d;
      const Tensor<1, 3> r  = dealii::cross_product_3d(to, e);
      const double       v  = odd_direction * r / d;
      return u >= 0 && v >= 0 && u + v <= 1 && f * r / d > 0;
    }

    /** A point is inside of a closed surface if a ray from it meets the surface
     * an odd number of times. */
    bool
    is_inside(const Point<3> &p, const std::vector<Corners> &faces)
    {
      const auto n =
        std::count_if(faces.begin(), faces.end(), [&](const Corners &face) {
          return face.size() == 2 ? meets_segment(p, face) :
                                    meets_triangle(p, face);
        });
      return n % 2 == 1;
    }

    double
    longest_edge(const Corners &face)
    {
      double longest = 0;
      for_each_edge(face.size(), [&](const std::size_t i, const std::size_t j) {
        longest = std::max(longest, face[i].distance(face[j]));
      });
      return longest;
    }

    Overlap
    overlap_at(const Point<3> &p, const std::vector<Corners> &faces)
    {
      Overlap result{p, 0, 0};
      for (const Corners &face : faces)
        if (const double d = closest_point(face, p).distance;
            result.edge == 0 || d < result.depth)
          {
            result.depth = d;
            result.edge  = longest_edge(face);
          }
      return result;
    }
  } // namespace

  /* Each node in the box of the other body is asked against all faces of it: as
     much work as nodes there times faces. Bodies that are apart cost their
     boxes only. */
  std::optional<Overlap>
  deepest_inside(const bodies::Structure &body, const bodies::Structure &other)
  {
    const std::vector<Corners> faces = simple_faces(other);
    std::optional<Overlap>     deepest;
    if (faces.empty())
      return deepest;
    Corners all;
    for (const Corners &face : faces)
      all.insert(all.end(), face.begin(), face.end());
    const Box box(all);
    for (const bodies::SurfaceNode &node :
         body.surface(body.boundary_ids()).nodes)
      if (box.point_inside(node.position) && is_inside(node.position, faces))
        if (const Overlap here = overlap_at(node.position, faces);
            !deepest || here.depth > deepest->depth)
          deepest = here;
    return deepest;
  }
} // namespace conetact::pairing
