// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_blunt_edges_h
#define conetact_pairing_blunt_edges_h

#include "conetact/pairing/face_net.h"

#include <map>
#include <utility>
#include <vector>

namespace conetact::pairing
{
  /**
   * Edges that are not sharp, such as that of a chamfer: at their nodes faces
   * turn clearly more than at the nodes beside them. What touches there has the
   * normal of the other side. Facets of a round surface turn alike at all
   * nodes, and are none.
   */
  class BluntEdges
  {
  public:
    /** `cosine`: of the angle from which on an edge is sharp, so that its sides
     * have normals of their own. */
    BluntEdges(const std::vector<FaceNet::Face> &faces, const double cosine);

    /** By how much more faces turn at a node than beside it [rad]; 0 where that
     * may be by the mesh. */
    double
    at(const unsigned int node) const;
    /** The mean over nodes, by the sizes of their weights. */
    double
    at(const std::vector<std::pair<unsigned int, double>> &nodes) const;
    /** How much the surface is bent over a mean of nodes [1/length]; below 0
     * where it is hollow. */
    double
    curvature(const std::vector<std::pair<unsigned int, double>> &nodes) const;

  private:
    std::map<unsigned int, double> excess, curvatures;
  };

  /** An edge, and what is bent beside it, of one side of a contact. */
  struct BentSide
  {
    double edge;      ///< BluntEdges::at() [rad]
    double curvature; ///< [1/length]
  };

  /**
   * Which part the normal of the one side has in a normal between both: none
   * where it has an edge. That of a flat side counts alone where the other one
   * is round, for it is the same all over the place where they touch; half of
   * both is their normal there where they are bent alike.
   */
  double
  part_of_normal(const BentSide &own, const BentSide &other);
} // namespace conetact::pairing

#endif
