// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_facing_parts_h
#define conetact_pairing_facing_parts_h

#include "conetact/pairing/face_net.h"
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
    /** What may be paired; the reasons stand in MasterSurface. */
    struct Limits
    {
      double reach;        ///< largest distance [length]
      double cosine;       ///< of the largest angle between opposing normals
      double interference; ///< beside the side of the body [length]
      bool   inside;       ///< whether a face may be inside the body at all
    };

    FacingParts(const bodies::Structure   &master,
                const bodies::BoundaryIds &ids);

    const std::vector<FaceNet::Face> &
    faces() const
    {
      return net.all();
    }

    struct Part
    {
      std::size_t   face; ///< of the master
      ProjectedFace projected;
      Polygon       where; ///< in the plane
    };
    /** Parts that do not overlap, the nearest first. */
    std::vector<Part>
    seen_from(const FaceNet::Face   &slave,
              const ProjectionPlane &plane,
              const ProjectedFace   &projected,
              const Limits          &limits) const;

  private:
    struct Candidate
    {
      Part   part;
      double distance;
    };
    std::vector<Candidate>
    candidates(const FaceNet::Face   &slave,
               const ProjectionPlane &plane,
               const ProjectedFace   &projected,
               const Limits          &limits) const;
    bool
    may_be_behind(const Point<3> &p,
                  const double    gap,
                  const double    size,
                  const Limits   &limits) const;

    FaceNet net;
    FaceNet whole; ///< boundary of the body
  };
} // namespace conetact::pairing

#endif
