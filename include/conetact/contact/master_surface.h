// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_master_surface_h
#define conetact_contact_master_surface_h

#include "conetact/structures/structure.h"

#include <optional>
#include <utility>
#include <vector>

namespace conetact
{
  /**
   * The faces of a body that nodes of another one may touch: node to segment
   * in the plane, node to bilinear face in space. Linearised at the undeformed
   * bodies.
   */
  class MasterSurface
  {
  public:
    MasterSurface(const Structure &body, const BoundaryIds &ids);

    struct Foot
    {
      double       gap;    ///< negative: interference [length]
      Tensor<1, 3> normal; ///< unit, from the master to the slave node
      /** Nodes of the face that is met, with its shape functions. */
      std::vector<std::pair<unsigned int, double>> masters;
    };
    /**
     * The foot of the perpendicular from p, on the nearest face that looks
     * against the slave's outward normal; none if p stands beside the surface
     * or further away than `reach`. A foot on an edge between two faces takes
     * the direction to p as normal.
     */
    std::optional<Foot>
    foot(const Point<3>     &p,
         const Tensor<1, 3> &slave_normal,
         const double        reach) const;

  private:
    struct Face
    {
      std::vector<unsigned int> nodes;
      std::vector<Point<3>>     corners;
      Point<3>                  centre;
      Tensor<1, 3>              outward; ///< of its nodes; zero: two sides
      double                    size;
    };
    struct Projection
    {
      Point<3>            point;
      Tensor<1, 3>        normal; ///< of the face, unit, either sign
      std::vector<double> weights;
      bool                on_rim; ///< at the outer edge of the surface
    };
    Projection
    project(const Face &face, const Point<3> &p) const;
    bool
    is_rim(const Face &face, const std::vector<double> &weights) const;

    std::vector<Face>         faces;
    std::vector<unsigned int> n_faces_at_node; ///< of each node of the body
  };
} // namespace conetact

#endif
