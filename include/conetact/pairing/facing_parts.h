// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_facing_parts_h
#define conetact_pairing_facing_parts_h

#include "conetact/pairing/master_surface.h"
#include "conetact/pairing/projected_face.h"

#include <vector>

namespace conetact::pairing
{
  /**
   * The faces of a master surface, and which parts of them a slave face sees
   * along its normal: faces are projected into the plane of the slave face
   * along its mean normal and clipped; where several lie behind one another
   * the nearest one is seen. Linearised at the undeformed bodies.
   */
  class FacingParts
  {
  public:
    /** The surface must outlive the object. */
    explicit FacingParts(const MasterSurface &master);

    const std::vector<FaceNet::Face> &
    faces() const
    {
      return master.net().all();
    }

    struct Part
    {
      std::size_t   face; ///< of the master
      ProjectedFace projected;
      Polygon       where; ///< in the plane
      double        gap;   ///< at the middle of what overlaps [length]
    };
    /** Parts that do not overlap, the nearest first. */
    std::vector<Part>
    seen_from(const FaceNet::Face         &slave,
              const ProjectionPlane       &plane,
              const ProjectedFace         &projected,
              const MasterSurface::Limits &limits) const;

  private:
    /** Parts that may hide one another. */
    std::vector<Part>
                         candidates(const FaceNet::Face         &slave,
                                    const ProjectionPlane       &plane,
                                    const ProjectedFace         &projected,
                                    const MasterSurface::Limits &limits) const;
    const MasterSurface &master;
  };
} // namespace conetact::pairing

#endif
