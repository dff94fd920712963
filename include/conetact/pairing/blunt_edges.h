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

  private:
    std::map<unsigned int, double> excess;
  };

  /** Which part the normal of the one side has in a normal between both, whose
   * edges turn by these angles: half where there are none. */
  double
  part_of_normal(const double own_edge, const double other_edge);
} // namespace conetact::pairing

#endif
