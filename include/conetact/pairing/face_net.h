// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_face_net_h
#define conetact_pairing_face_net_h

#include "conetact/bodies/structure.h"
#include "conetact/pairing/closest_point.h"
#include "conetact/pairing/face_tree.h"

#include <algorithm>
#include <vector>

namespace conetact::pairing
{
  /**
   * The faces of a surface and how they are joined: which faces meet at an
   * edge (in the plane: at an end), which edges are the rim because one face
   * of the surface only has them. An edge with a hanging node is shared by the
   * coarse face and the fine ones.
   */
  class FaceNet
  {
  public:
    struct Edge
    {
      Tensor<1, 3>             outward;  ///< in the face, unit, across the edge
      std::vector<std::size_t> partners; ///< other faces that have the edge
      Point<3>                 middle;
      /** From the middle to one of its corners [length]; 0 in the plane. */
      Tensor<1, 3> half;
      /** In the only partner, unit, across the edge and away from it; 0: not
       * known. */
      Tensor<1, 3> beyond;
      bool
      is_rim() const
      {
        return partners.empty();
      }
    };
    struct Face
    {
      std::vector<unsigned int> nodes;
      std::size_t n_functions = 0; ///< its first nodes that contacts stand at
      std::vector<Point<3>> corners;
      /** Places of its other nodes, where faces may be bent; else none. */
      std::vector<Point<3>> middles;
      std::vector<Edge>     edges;   ///< as many as corners
      Tensor<1, 3>          outward; ///< mean unit normal
      Point<3>              centre;
      double radius = 0; ///< of the ball about it that holds corners [length]
      double size   = 0; ///< longest edge [length]
      /** How far its middles stand off its chords, at most [length]. */
      double sagitta = 0;
      /** Sine of half the turn to its smooth neighbours. */
      double bend = 0;
      /** Sine of the largest turn to any neighbour, 1 from 90 degrees on. */
      double turn = 0;
      /** Whether it and its neighbours are flat, and some of them are turned
       * so much that `turn` tells little. */
      bool is_at_flat_edge = false;
      /** There: unit vectors along all edges of the surface that leave each of
       * its corners, but in the plane. */
      std::vector<std::vector<Tensor<1, 3>>> leaving;

      /** Whether it is a line in space, which has normals all around. */
      bool
      is_line_in_space() const
      {
        return corners.size() == 2 &&
               (corners[0][2] != 0 || corners[1][2] != 0);
      }

      /**
       * Whether the nearest point of the surface may be on this face: a point
       * stands off along normals of the face and its neighbours.
       */
      bool
      may_have_foot(const Point<3> &p) const
      {
        if (is_line_in_space() || (corners.size() == 2 && p[2] != 0))
          return true;
        const Tensor<1, 3> arm    = p - centre;
        const double       beside = (arm - (arm * outward) * outward).norm();
        return beside <= 1.1 * radius + turn * arm.norm() &&
               (!is_at_flat_edge || beside <= 1.1 * radius + .02 * arm.norm() ||
                may_have_foot_on_edge(p));
      }

    private:
      bool
      may_have_foot_on_edge(const Point<3> &p) const;
      bool
      may_have_foot_at_corner(const std::size_t i, const Point<3> &p) const;
    };
    FaceNet(const bodies::Structure &body, const bodies::Surface &surface);

    const std::vector<Face> &
    all() const
    {
      return faces;
    }
    const FaceTree &
    places() const
    {
      return tree;
    }

    /** A face's closest point to p and the outward unit normal there. */
    struct Closest : ClosestPoint
    {
      std::size_t  face = 0;
      Tensor<1, 3> normal;
    };
    Closest
    project(const std::size_t face, const Point<3> &p) const;

    /** The nearest point of all faces. */
    Closest
    nearest(const Point<3> &p) const;

    /** Numbers of the face's edges that a point of it lies on. */
    std::vector<std::size_t>
    edges_at(const Closest &at) const;

    /**
     * All faces that meet in a closest point, with it the feature of the
     * surface there: a face, an edge, a vertex. Empty if one of them comes
     * nearer to p elsewhere: then the point is no closest one of the surface.
     */
    std::vector<Closest>
    feature(const Closest &at, const Point<3> &p) const;

    /**
     * Tells outside from inside at an edge or a vertex: the sum of its faces'
     * normals, each times the face's angle there (Baerentzen, Aanaes, IEEE
     * Trans. Visual. 11 (2005) 243-253).
     */
    Tensor<1, 3>
    sum_of_normals(const std::vector<Closest> &feature) const;

    /** On which side of the surface p is, whose nearest point is given: 1
     * outside, -1 inside. */
    double
    side(const Closest &nearest, const Point<3> &p) const;

    /**
     * Distance of p from the surface, which must be closed, over the size of
     * the nearest face; negative inside.
     */
    double
    signed_distance(const Point<3> &p) const;

    /** Whether the surface, which must be closed, has p inside: as far away as
     * it may be, by how much of its view the surface fills. */
    bool
    encloses(const Point<3> &p) const;
    /** How far inside p is, over the size of the nearest face; 0 outside, also
     * far away, where the nearest faces alone may mislead. */
    double
    depth(const Point<3> &p) const
    {
      return encloses(p) ? std::max(0., -signed_distance(p)) : 0.;
    }

  private:
    void
    join_edges();
    void
    join_hanging_edges(const bodies::Structure &body);
    void
    measure_turns();
    void
    find_flat_edges();
    Tensor<1, 3>
    beyond_edge(const std::size_t face, const std::size_t edge) const;
    std::vector<Tensor<1, 3>>
    edges_leaving(const unsigned int node) const;

    /** All that share an edge or a node with it, and itself, each once. */
    std::vector<std::size_t>
    neighbours(const Face &face) const;

    std::vector<Face>                     faces;
    std::vector<std::vector<std::size_t>> faces_at_node;
    FaceTree                              tree;
  };
} // namespace conetact::pairing

#endif
