// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/face_net.h"

#include "conetact/bodies/face_nodes.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace conetact::pairing
{
  namespace
  {
    /** Misses below this part of a face's size are round-off. */
    constexpr double corner_round_off = 1e-8;

    using EdgeCorners = std::array<unsigned int, 4>;

    /**
     * The corners of an edge, then those opposite to them. A quadrilateral has
     * the edges a = 0, a = 1, b = 0 and b = 1, a triangle has a = 0, b = 0 and
     * a + b = 1.
     */
    const EdgeCorners &
    edge_corners(const std::size_t n_corners, const std::size_t edge)
    {
      static constexpr std::array<EdgeCorners, 4> of_quadrilateral = {
        {{{0, 2, 1, 3}}, {{1, 3, 0, 2}}, {{0, 1, 2, 3}}, {{2, 3, 0, 1}}}};
      static constexpr std::array<EdgeCorners, 3> of_triangle = {
        {{{0, 2, 1, 1}}, {{0, 1, 2, 2}}, {{1, 2, 0, 0}}}};
      return n_corners == 3 ? of_triangle[edge] : of_quadrilateral[edge];
    }

    /** How far a point of a face is from one of its edges, over its size. */
    double
    distance_to_edge(const std::size_t            n_corners,
                     const std::array<double, 2> &at,
                     const std::size_t            edge)
    {
      if (n_corners == 3)
        return edge == 2 ? 1 - at[0] - at[1] : at[edge];
      return edge % 2 == 0 ? at[edge / 2] : 1 - at[edge / 2];
    }

    using Nodes = std::vector<unsigned int>;

    /** From one corner of an edge to the other one; in the plane it is one
     * point. */
    Tensor<1, 3>
    along_edge(const std::vector<Point<3>> &x, const std::size_t edge)
    {
      if (x.size() == 2)
        return {};
      const auto &c = edge_corners(x.size(), edge);
      return x[c[1]] - x[c[0]];
    }

    /** The nodes of an edge, sorted; in the plane an edge is one node. */
    Nodes
    edge_nodes(const FaceNet::Face &face, const std::size_t edge)
    {
      const std::size_t n = face.corners.size();
      if (n == 2)
        return {face.nodes[edge]};
      const auto &c     = edge_corners(n, edge);
      Nodes       nodes = {face.nodes[c[0]], face.nodes[c[1]]};
      for (const bodies::MiddleNode &middle :
           bodies::middle_nodes(3, face.nodes.size()))
        if (middle.corners.size() == 2 &&
            std::is_permutation(middle.corners.begin(),
                                middle.corners.end(),
                                c.begin(),
                                c.begin() + 2))
          nodes.push_back(face.nodes[middle.node]);
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    }

    Tensor<1, 3>
    across_edge(const std::vector<Point<3>> &x, const std::size_t edge)
    {
      Tensor<1, 3> across;
      if (x.size() == 2)
        across = x[edge] - x[1 - edge];
      else
        {
          const auto  &c     = edge_corners(x.size(), edge);
          Tensor<1, 3> along = x[c[1]] - x[c[0]];
          along /= along.norm();
          // The vector from the opposite corners to those of the edge, without
          // its part along that, is in the plane of the face and points out of
          // it.
          across = (x[c[0]] - x[c[2]]) + (x[c[1]] - x[c[3]]);
          across -= (across * along) * along;
        }
      return across / across.norm();
    }

    FaceNet::Edge
    make_edge(const std::vector<Point<3>> &x, const std::size_t edge)
    {
      const std::size_t first =
        x.size() == 2 ? edge : edge_corners(x.size(), edge)[0];
      const Tensor<1, 3> half = .5 * along_edge(x, edge);
      return {across_edge(x, edge), {}, x[first] + half, half, {}};
    }

    double
    edge_length(const FaceNet::Face &face, const std::size_t edge)
    {
      const auto &c = edge_corners(face.corners.size(), edge);
      return face.corners[c[0]].distance(face.corners[c[1]]);
    }

    /** The sagitta of a face that contacts meet at corners only: how far a
     * middle node stands off the mean of the corners that it is between. */
    double
    sagitta_of(const bodies::Structure &body, const bodies::SurfaceFace &face)
    {
      double largest = 0;
      if (face.meets_at_corners)
        for (const bodies::HangingNode &middle :
             bodies::middle_nodes(body, face))
          {
            Tensor<1, 3> off;
            for (const auto &[corner, part] : middle.masters)
              off +=
                part * (body.position(middle.node) - body.position(corner));
            largest = std::max(largest, off.norm());
          }
      return largest;
    }

    FaceNet::Face
    make_face(const bodies::Structure &body, const bodies::SurfaceFace &from)
    {
      FaceNet::Face face;
      face.nodes          = from.nodes;
      face.outward        = from.normal;
      const std::size_t n = bodies::n_corners(body, from);
      face.n_functions    = from.meets_at_corners ? n : from.nodes.size();
      for (std::size_t i = 0; i < n; ++i)
        {
          face.corners.push_back(body.position(from.nodes[i]));
          face.centre +=
            Tensor<1, 3>(face.corners.back()) / static_cast<double>(n);
        }
      if (from.meets_at_corners)
        for (std::size_t i = n; i < from.nodes.size(); ++i)
          face.middles.push_back(body.position(from.nodes[i]));
      face.sagitta = sagitta_of(body, from);
      for (const Point<3> &corner : face.corners)
        face.radius = std::max(face.radius, face.centre.distance(corner));
      for (std::size_t e = 0; e < n; ++e)
        {
          face.edges.push_back(make_edge(face.corners, e));
          if (n > 2)
            face.size = std::max(face.size, edge_length(face, e));
        }
      if (n == 2)
        face.size = 2 * face.radius;
      return face;
    }

    /** The angle that a face fills around a point of it. */
    double
    angle_at(const FaceNet::Face &face, const std::vector<std::size_t> &edges)
    {
      if (face.corners.size() == 2 || edges.size() == 1)
        return M_PI;
      if (edges.empty())
        return 2 * M_PI;
      const double cosine =
        face.edges[edges[0]].outward * face.edges[edges[1]].outward;
      // Half a turn along an edge, a full one inside; at a corner what its two
      // edges leave.
      return M_PI - std::acos(std::clamp(cosine, -1., 1.));
    }

    /** The balls around faces, for a tree. */
    std::vector<FaceTree::Ball>
    balls_of(const std::vector<FaceNet::Face> &faces)
    {
      std::vector<FaceTree::Ball> balls;
      for (const FaceNet::Face &face : faces)
        balls.push_back({face.centre, face.radius});
      return balls;
    }
  } // namespace

  FaceNet::FaceNet(const bodies::Structure &body,
                   const bodies::Surface   &surface)
    : faces_at_node(body.n_nodes())
  {
    for (const bodies::SurfaceFace &face : surface.faces)
      {
        for (const unsigned int node : face.nodes)
          faces_at_node[node].push_back(faces.size());
        faces.push_back(make_face(body, face));
      }
    join_edges();
    if (!body.hanging_nodes().empty())
      join_hanging_edges(body);
    measure_turns();
    find_flat_edges();
    tree = FaceTree(balls_of(faces));
  }

  std::vector<std::size_t>
  FaceNet::neighbours(const Face &face) const
  {
    std::vector<std::size_t> all;
    for (const Edge &edge : face.edges)
      all.insert(all.end(), edge.partners.begin(), edge.partners.end());
    for (const unsigned int node : face.nodes)
      all.insert(all.end(),
                 faces_at_node[node].begin(),
                 faces_at_node[node].end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /**
   * Joins faces across edges: partners have all nodes of the edge. Asking the
   * faces at its first node alone keeps this in proportion to the number of
   * faces.
   */
  void
  FaceNet::join_edges()
  {
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t e = 0; e < faces[f].edges.size(); ++e)
        {
          const Nodes nodes = edge_nodes(faces[f], e);
          for (const std::size_t other : faces_at_node[nodes[0]])
            if (other != f &&
                std::all_of(nodes.begin(),
                            nodes.end(),
                            [&](const unsigned int node) {
                              const Nodes &has = faces[other].nodes;
                              return std::count(has.begin(), has.end(), node);
                            }))
              faces[f].edges[e].partners.push_back(other);
        }
  }

  void
  FaceNet::join_hanging_edges(const bodies::Structure &body)
  {
    std::map<unsigned int, std::set<unsigned int>> followed;
    for (const bodies::HangingNode &hanging : body.hanging_nodes())
      for (const auto &[master, weight] : hanging.masters)
        followed[hanging.node].insert(master);
    // Parts of an edge and the whole have one key: in place of a node that
    // hangs stand those that it follows.
    std::map<std::set<unsigned int>,
             std::vector<std::pair<std::size_t, std::size_t>>>
      groups;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t e = 0; e < faces[f].edges.size(); ++e)
        if (faces[f].edges[e].is_rim() && faces[f].corners.size() > 2)
          {
            std::set<unsigned int> key;
            for (const unsigned int node : edge_nodes(faces[f], e))
              if (const auto found = followed.find(node);
                  found != followed.end())
                key.insert(found->second.begin(), found->second.end());
              else
                key.insert(node);
            groups[key].emplace_back(f, e);
          }
    for (const auto &[key, edges] : groups)
      for (const auto &[f, e] : edges)
        for (const auto &[g, h] : edges)
          // A part of the edge is half as long or less; its equals on the other
          // side are partners already.
          if (edge_length(faces[f], e) > 1.3 * edge_length(faces[g], h))
            {
              faces[f].edges[e].partners.push_back(g);
              faces[g].edges[h].partners.push_back(f);
            }
  }

  /* The nearest point of one face, on an edge of it where p is beside it: no
     neighbour is asked. */
  FaceNet::Closest
  FaceNet::project(const std::size_t face, const Point<3> &p) const
  {
    AssertIndexRange(face, faces.size());
    Closest result;
    static_cast<ClosestPoint &>(result) = closest_point(faces[face].corners, p);
    result.face                         = face;
    result.normal = face_normal_at(faces[face].corners, result.at);
    // The order of the corners tells no side, the body does.
    if (result.normal * faces[face].outward < 0)
      result.normal = -result.normal;
    return result;
  }

  /* The edges that a point of a face is on: none inside, two at a corner. */
  std::vector<std::size_t>
  FaceNet::edges_at(const Closest &at) const
  {
    AssertIndexRange(at.face, faces.size());
    std::vector<std::size_t> edges;
    for (std::size_t e = 0; e < faces[at.face].edges.size(); ++e)
      if (distance_to_edge(faces[at.face].corners.size(), at.at, e) <=
          corner_round_off)
        edges.push_back(e);
    return edges;
  }

  std::vector<FaceNet::Closest>
  FaceNet::feature(const Closest &at, const Point<3> &p) const
  {
    const Face           &face  = faces[at.face];
    const auto            edges = edges_at(at);
    std::set<std::size_t> others;
    for (const std::size_t e : edges)
      others.insert(face.edges[e].partners.begin(),
                    face.edges[e].partners.end());
    const auto weights = shape_values(face.corners.size(), at.at);
    for (std::size_t i = 0; i < face.corners.size(); ++i)
      // At a corner all faces of the node meet, not only those across edges.
      if (weights[i] >= 1 - 2 * corner_round_off)
        others.insert(faces_at_node[face.nodes[i]].begin(),
                      faces_at_node[face.nodes[i]].end());
    std::vector<Closest> result = {at};
    for (const std::size_t other : others)
      if (other != at.face)
        {
          const Closest there = project(other, p);
          const double  scale =
            corner_round_off * std::max(face.size, at.distance);
          // A neighbour is nearer: the foot belongs there.
          if (there.distance < at.distance - scale)
            return {};
          // Distances are flat about their minimum: their points agree to the
          // root of what they agree to themselves.
          if (there.point.distance(at.point) <=
              10 * std::sqrt(corner_round_off) * face.size)
            result.push_back(there);
        }
    return result;
  }

  Tensor<1, 3>
  FaceNet::sum_of_normals(const std::vector<Closest> &feature) const
  {
    // The weights are angles, which do not change with the way in which a mesh
    // divides the faces around. A plain sum of normals does, and may have the
    // wrong sign at a vertex.
    Tensor<1, 3> sum;
    for (const Closest &at : feature)
      sum += angle_at(faces[at.face], edges_at(at)) * at.normal;
    return sum;
  }

  FaceNet::Closest
  FaceNet::nearest(const Point<3> &p) const
  {
    Assert(!faces.empty(), dealii::ExcMessage("A surface has faces."));
    Closest nearest;
    nearest.distance = std::numeric_limits<double>::max();
    // balls around p that grow until they hold the nearest face
    double searched = 0;
    for (double radius = faces[0].radius; searched < nearest.distance;
         radius *= 2)
      {
        for (const std::size_t f : tree.near({p, radius}))
          // No point of a face is nearer than its ball.
          if (faces[f].centre.distance(p) - faces[f].radius < nearest.distance)
            if (const Closest closest = project(f, p);
                closest.distance < nearest.distance)
              nearest = closest;
        searched = radius;
      }
    return nearest;
  }

  /* Tells the side by the pseudonormal, which is right at edges and corners as
     well, where the normal of a single face is not. */
  double
  FaceNet::side(const Closest &at, const Point<3> &p) const
  {
    return (p - at.point) * sum_of_normals(feature(at, p)) < 0 ? -1 : 1;
  }

  /* In sizes of the face that is nearest: a depth counts by what meshes
     resolve. */
  double
  FaceNet::signed_distance(const Point<3> &p) const
  {
    const Closest at = nearest(p);
    return side(at, p) * at.distance / faces[at.face].size;
  }

  namespace
  {
    /**
     * The share of all directions from p in which a triangle is, a solid angle
     * Omega over 4 pi, positive where p is behind it: tan(Omega / 2) = a . (b x
     * c) / (|a| |b| |c| + (a . b) |c| + (b . c) |a| + (c . a) |b|) with its
     * corners a, b, c seen from p (van Oosterom, Strackee, IEEE Trans. Biomed.
     * Eng. 30 (1983) 125-126).
     */
    double
    share_of_triangle(const std::array<Tensor<1, 3>, 3> &corner,
                      const Tensor<1, 3>                &outward)
    {
      const auto &[a, b, c]     = corner;
      const Tensor<1, 3> normal = cross_product_3d(b - a, c - a);
      const double       volume = a * cross_product_3d(b, c);
      const double       angle =
        2 * std::atan2(volume,
                       a.norm() * b.norm() * c.norm() + (a * b) * c.norm() +
                         (b * c) * a.norm() + (c * a) * b.norm());
      return (normal * outward < 0 ? -angle : angle) / (4 * M_PI);
    }

    /** The share of a line in the plane, an angle over 2 pi, positive where p
     * is behind it. */
    double
    share_of_line(const Tensor<1, 3> &a,
                  const Tensor<1, 3> &b,
                  const Tensor<1, 3> &outward)
    {
      const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a * b);
      const double along = (b - a)[1] * outward[0] - (b - a)[0] * outward[1];
      return (along < 0 ? -angle : angle) / (2 * M_PI);
    }

    double
    share_of_view(const FaceNet::Face &face, const Point<3> &p)
    {
      std::vector<Tensor<1, 3>> arm;
      for (const Point<3> &corner : face.corners)
        arm.push_back(corner - p);
      if (arm.size() == 2)
        return share_of_line(arm[0], arm[1], face.outward);
      double share =
        share_of_triangle({{arm[0], arm[1], arm[2]}}, face.outward);
      if (arm.size() == 4)
        share += share_of_triangle({{arm[1], arm[3], arm[2]}}, face.outward);
      return share;
    }
  } // namespace

  bool
  FaceNet::encloses(const Point<3> &p) const
  {
    // Shares sum to the winding number: 1 inside of a closed surface, 0
    // outside. The half between them is far from both, whatever the rounding.
    double share = 0;
    for (const Face &face : faces)
      share += share_of_view(face, p);
    return share > .5;
  }
} // namespace conetact::pairing
