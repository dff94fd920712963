// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_node_to_face_h
#define conetact_pairing_node_to_face_h

#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/faces_on_obstacle.h"
#include "conetact/pairing/master_surface.h"

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace conetact::pairing
{
  /** Diagonal of the box around two bodies: no gap between them is larger
   * [length]. */
  double
  size_of(const bodies::Structure &one, const bodies::Structure &other);

  /** How deep a node may start in its opponent [length]. */
  double
  interference_allowed(const Contact &contact, const double face_size);

  /**
   * Pairs each node of a surface by itself: with an obstacle, or with the
   * nearest face of a master that opposes it (MasterSurface). Contact and
   * structures must outlive it.
   */
  class NodeToFace
  {
  public:
    NodeToFace(const Contact                                &contact,
               const std::vector<const bodies::Structure *> &structures);

    const bodies::Surface &
    slave_surface() const
    {
      return surface;
    }

    /** Of a contact with a master body. */
    const MasterSurface &
    master_surface() const
    {
      return *master;
    }

    /**
     * Whether both sides of a self contact have the node, as the tip of a crack
     * does: it is joined there, and is no contact node.
     */
    bool
    is_joined(const unsigned int node) const
    {
      return joined.count(node) > 0;
    }

    /** Whether it is one that contacts stand at: all, or corners only. */
    bool
    stands(const unsigned int node) const
    {
      return !on_obstacle || on_obstacle->has(node);
    }

    /** A node of the contact without its opponent. */
    ContactNode
    free_node(const bodies::SurfaceNode &s) const;
    /** The same as one that is out of reach now, but may slide there; its faces
     * have this outward normal, of unit length. */
    ContactNode
    apart(const bodies::SurfaceNode &s, const Tensor<1, 3> &outward) const;
    /** Of a contact that has a Gap: the mean that the node is of it. */
    double
    prescribed_gap(const ContactNode &node) const;
    /** A node with its gap and normal, unless it stays free. */
    std::optional<ContactNode>
    find(const bodies::SurfaceNode &s);
    /**
     * Rows of a node of a contact of its own: as find(), and another one where
     * the faces on another side of its sharp edge meet the master along another
     * normal, as in a corner. Empty: it stays free; of a contact that slides,
     * as many rows wherever it is. A tie holds all directions with one.
     */
    std::vector<ContactNode>
    find_sides(const bodies::SurfaceNode &s);
    /** The point of the master that a node meets whose faces have these normals
     * there; none: it stays free. */
    std::optional<MasterSurface::Foot>
    foot(const bodies::SurfaceNode       &s,
         const std::vector<Tensor<1, 3>> &normals) const;
    /** Takes down a node that starts too deep. */
    void
    judge(const ContactNode &node, const double face_size);

    const std::optional<PairedNodes::Deep> &
    deepest_node() const
    {
      return deepest;
    }

  private:
    /** Faces at a node on one side of its sharp edge. */
    struct Side
    {
      Tensor<1, 3> outward; ///< unit, mean over them
      double       part;    ///< of the area of the node
    };
    void
    find_edges();
    std::vector<Side>
    sides_of(const unsigned int node);
    bool
    sees(const Side &side, const ContactNode &row) const;
    bool
    face_obstacle(ContactNode &node);
    bool
    face_master(ContactNode &node, const bodies::SurfaceNode &s);
    MasterSurface::Limits
    limits(const double face_size) const;
    std::optional<ContactNode>
    find_other(const bodies::SurfaceNode &s,
               const Side                &side,
               const ContactNode         &first) const;

    const Contact                 &contact;
    const bodies::Structure       &body;
    bodies::Surface                surface;
    std::map<unsigned int, double> spacing;
    std::set<unsigned int>         joined;           ///< nodes of both sides
    using Sides = std::multimap<unsigned int, Side>; ///< of nodes
    std::optional<Sides>
      edges; ///< those at sharp edges, when they are asked for
    std::optional<MasterSurface>     master;
    std::optional<FacesOnObstacle>   on_obstacle; ///< met by means over faces
    std::optional<PairedNodes::Deep> deepest;
  };

  /** All nodes of a contact; where they stand at corners, corners_to_faces.h.
   */
  PairedNodes
  pair_nodes_with_faces(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures);
} // namespace conetact::pairing

#endif
