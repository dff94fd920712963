// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_faces_on_obstacle_h
#define conetact_pairing_faces_on_obstacle_h

#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/face_net.h"

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace conetact::pairing
{
  /**
   * How faces that contacts stand at the corners of meet an obstacle: what a
   * corner j has is the mean @f$\int \varphi_j v / \int \varphi_j@f$ over the
   * faces around it, with the functions of corners of corner_functions()
   * (dual_functions.h), of displacements and of gaps of second degree, each
   * node's to the nearest point of the obstacle. The functions sum to 1, so a
   * uniform pressure passes exactly. (After Popp, Wohlmuth, Gee, Wall, SIAM J.
   * Sci. Comput. 34 (2012) B421-B446.)
   */
  class FacesOnObstacle
  {
  public:
    /** Of a node of the body [length]. */
    using Displacement = std::function<Tensor<1, 3>(const unsigned int node)>;

    /** Contact and body must outlive it. */
    FacesOnObstacle(const Contact           &contact,
                    const bodies::Structure &body,
                    const bodies::Surface   &surface);

    /** Whether faces of the surface are met like that. */
    static bool
    suits(const bodies::Surface &surface);

    /** Whether it is a corner. */
    bool
    has(const unsigned int node) const
    {
      return rows.count(node) > 0;
    }

    /** Means over the faces around a corner, in the obstacle's own frame. */
    struct Met
    {
      double       gap;
      Tensor<1, 3> normal; ///< at the corner: on planes of symmetry in them
      Point<3>     foot;   ///< on the obstacle
      /** Gap of the nodes that it is a mean over. */
      double least = std::numeric_limits<double>::max();
    };
    /** Where the obstacle and the nodes are; nothing where it has no normal at
     * one of them. */
    std::optional<Met>
    meet(const ContactNode  &node,
         const RigidMotion  &motion,
         const Displacement &at) const;

    /** Gives an undeformed node its gap, normal, area and slaves. */
    void
    place(ContactNode &node) const;

  private:
    /** Of a corner: its faces' nodes and their parts of the mean. */
    struct Row
    {
      std::map<unsigned int, double> slaves; ///< parts of a sum of 1
      double                         area = 0;
      /** Over the cosine between the normals of a slave and of the corner: so
       * that a uniform pressure passes where the obstacle bends. */
      std::map<unsigned int, double> weights;
      double                         whole = 1; ///< sum of the weights
    };
    void
    add(const std::size_t face, const std::vector<bool> &of_row);
    void
    weigh(const unsigned int node, Row &row) const;

    const Contact                 &contact;
    const bodies::Structure       &body;
    FaceNet                        net;
    std::map<unsigned int, double> spacing; ///< of nodes [length]
    double                         thickness;
    std::map<unsigned int, Row>    rows; ///< by their nodes
  };
} // namespace conetact::pairing

#endif
