// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/overlap.h"

#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/closest_point.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/boost_adaptors/segment.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>
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

    double
    longest_edge(const Corners &face)
    {
      double longest = 0;
      for_each_edge(face.size(), [&](const std::size_t i, const std::size_t j) {
        longest = std::max(longest, face[i].distance(face[j]));
      });
      return longest;
    }

    double
    distance(const Box &box, const Point<3> &p)
    {
      Tensor<1, 3> arm;
      for (unsigned int d = 0; d < 3; ++d)
        arm[d] =
          std::max({0., box.lower_bound(d) - p[d], p[d] - box.upper_bound(d)});
      return arm.norm();
    }
  } // namespace

  Boundary::Boundary(const bodies::Structure &body)
  {
    const bodies::Surface surface = body.surface(body.boundary_ids());
    for (const bodies::SurfaceNode &node : surface.nodes)
      nodes.push_back(node.node);
    if (surface.two_sided)
      return;
    for (const bodies::SurfaceFace &face : surface.faces)
      for (const auto &part : bodies::parts_of_first_degree(body, face))
        {
          are_segments = part.size() == 2;
          faces.push_back({{part[0], part[1], part[are_segments ? 1 : 2]}});
          if (part.size() == 4) // deal.II's order
            faces.push_back({{part[1], part[3], part[2]}});
        }
  }

  struct Solid::Tree
  {
    Box                                        whole;
    dealii::RTree<std::pair<Box, std::size_t>> faces;
  };

  Solid::Solid(const Boundary &of, const bodies::Structure &where)
    : boundary(of)
    , body(where)
  {}

  Corners
  Solid::corners(const std::size_t face) const
  {
    const Boundary::Face &nodes = boundary.faces[face];
    Corners corners = {body.position(nodes[0]), body.position(nodes[1])};
    if (!boundary.are_segments)
      corners.push_back(body.position(nodes[2]));
    return corners;
  }

  const Solid::Tree &
  Solid::tree_of_faces() const
  {
    // A ray that a face meets must not miss its box by rounding.
    constexpr double rounding = 1e-10;
    if (tree)
      return *tree;
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (std::size_t f = 0; f < boundary.faces.size(); ++f)
      boxes.emplace_back(Box(corners(f)), f);
    Box whole = boxes[0].first;
    for (const auto &[box, f] : boxes)
      whole.merge_with(box);
    double size = 0;
    for (unsigned int d = 0; d < 3; ++d)
      size = std::max({size, -whole.lower_bound(d), whole.upper_bound(d)});
    for (auto &[box, f] : boxes)
      box.extend(rounding * size);
    tree = std::make_shared<const Tree>(Tree{whole, dealii::pack_rtree(boxes)});
    return *tree;
  }

  /** A point is inside of a closed surface if a ray from it meets the surface
   * an odd number of times. */
  bool
  Solid::has_inside(const Point<3> &p, const Tree &among) const
  {
    namespace geometry = boost::geometry;
    Tensor<1, 3> ray   = odd_direction;
    if (boundary.are_segments)
      ray[2] = 0;
    double length = 0;
    for (unsigned int d = 0; d < 3; ++d)
      length += 4 * among.whole.side_length(d);
    const geometry::model::segment<Point<3>> along(p, p + length * ray);
    bool                                     inside = false;
    for (const auto &[box, f] :
         among.faces | geometry::index::adaptors::queried(
                         geometry::index::intersects(along)))
      if (boundary.are_segments ? meets_segment(p, corners(f)) :
                                  meets_triangle(p, corners(f)))
        inside = !inside;
    return inside;
  }

  Overlap
  Solid::overlap_at(const Point<3> &p, const Tree &among) const
  {
    Overlap     result{p, std::numeric_limits<double>::max(), 0};
    std::size_t nearest = boundary.faces.size();
    // Boxes come from the nearest one on. Of faces that are as near the first
    // one counts, whatever the tree.
    for (auto next = among.faces.qbegin(boost::geometry::index::nearest(
           p, static_cast<unsigned int>(boundary.faces.size())));
         next != among.faces.qend() && distance(next->first, p) <= result.depth;
         ++next)
      if (const double d = closest_point(corners(next->second), p).distance;
          d < result.depth || (d == result.depth && next->second < nearest))
        {
          nearest      = next->second;
          result.depth = d;
        }
    result.edge = longest_edge(corners(nearest));
    return result;
  }

  /* Each node in the box is asked against the faces on a ray from it, and where
     it is inside against those near it. Bodies that are apart cost their boxes
     only. */
  std::optional<Overlap>
  Solid::deepest_inside(const Solid &other) const
  {
    std::optional<Overlap> deepest;
    if (boundary.faces.empty())
      return deepest;
    const Tree &among = tree_of_faces();
    for (const unsigned int node : other.boundary.nodes)
      if (const Point<3> p = other.body.position(node);
          among.whole.point_inside(p) && has_inside(p, among))
        if (const Overlap here = overlap_at(p, among);
            !deepest || here.depth > deepest->depth)
          deepest = here;
    return deepest;
  }
} // namespace conetact::pairing
