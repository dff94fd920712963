// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_master_normals_h
#define conetact_pairing_master_normals_h

#include "conetact/bodies/structure.h"
#include "conetact/pairing/blunt_edges.h"

#include <map>
#include <utility>
#include <vector>

namespace conetact::pairing
{
  /**
   * Normals between two surfaces that close a gap. Where they touch they become
   * one: that of a plane side where the other one is round, between both of two
   * equal bodies, so that it is the same all over the place where they touch.
   * An edge that is not sharp takes the normal of the other side.
   */
  class MasterNormals
  {
  public:
    /** `sharp_edge`: the angle from which on sides of an edge have normals of
     * their own [rad]. */
    MasterNormals(const bodies::Surface            &master,
                  const std::vector<FaceNet::Face> &slave_faces,
                  const std::vector<FaceNet::Face> &master_faces,
                  const double                      sharp_edge);

    /**
     * From the master to the slave: between the unit normal out of the slave at
     * a node of it, and that of the master, a mean over its own functions if it
     * is bent (`of_bent`, of any length), else over these nodes.
     */
    Tensor<1, 3>
    between(const unsigned int                                  node,
            const Tensor<1, 3>                                 &outward,
            const std::vector<std::pair<unsigned int, double>> &masters,
            const Tensor<1, 3>                                 &of_bent) const;

  private:
    Tensor<1, 3>
    mean(const Tensor<1, 3>                                 &outward,
         const std::vector<std::pair<unsigned int, double>> &masters) const;

    std::map<unsigned int, std::vector<Tensor<1, 3>>> normals;
    BluntEdges                                        slave_edges, master_edges;
  };
} // namespace conetact::pairing

#endif
