// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/facing_parts.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    /** Parts below this share of the slave face are what clipping leaves by
     * rounding. */
    constexpr double sliver = 1e-14;
  } // namespace

  FacingParts::FacingParts(const MasterSurface &surface)
    : master(surface)
  {}

  /** Finds the master's faces before or behind a slave face whose shadows in
   * its plane overlap it; which one hides which is left to seen_from(). */
  std::vector<FacingParts::Part>
  FacingParts::candidates(const FaceNet::Face         &slave,
                          const ProjectionPlane       &plane,
                          const ProjectedFace         &projected,
                          const MasterSurface::Limits &limits) const
  {
    std::vector<Part> found;
    const double      whole_area = measure(projected.outline());
    for (const std::size_t f : master.net().places().along(
           {slave.centre, slave.radius}, slave.outward, limits.reach))
      {
        const FaceNet::Face &face = master.net().all()[f];
        // Faces meet that look at each other, within the angle of limits.
        if (-(face.outward * slave.outward) < limits.cosine)
          continue;
        // Looking along the normal: a face of the master that looks away or
        // sideways has no shadow to clip.
        const ProjectedFace other(face, plane);
        if (!boxes_overlap(projected.outline(), other.outline()))
          continue;
        Polygon where = common_part(projected.outline(), other.outline());
        if (measure(where) <= sliver * whole_area)
          continue;
        // One distance a part, at its middle: it decides which of several parts
        // is seen, integrals have their own.
        const ProjectedFace::Seen here = projected.at(middle(where));
        const double   gap = other.over(here.place).height - here.height;
        const Point<3> p =
          plane.origin +
          plane.in_space({here.place[0], here.place[1], here.height});
        if (std::abs(gap) <= limits.reach &&
            master.may_be_behind(
              p, gap, face, std::max(slave.size, face.size), limits))
          found.push_back({f, other, std::move(where), gap});
      }
    return found;
  }

  std::vector<FacingParts::Part>
  FacingParts::seen_from(const FaceNet::Face         &slave,
                         const ProjectionPlane       &plane,
                         const ProjectedFace         &projected,
                         const MasterSurface::Limits &limits) const
  {
    auto found = candidates(slave, plane, projected, limits);
    std::stable_sort(found.begin(),
                     found.end(),
                     [](const Part &a, const Part &b) {
                       return std::abs(a.gap) < std::abs(b.gap);
                     });
    // Outlines of bent faces leave slivers between them, through which the far
    // side of the body could be seen that the face has begun to enter: where
    // something is near, what is deeper than the face is long does not count.
    if (!found.empty() && std::abs(found.front().gap) <= slave.size)
      found.erase(std::remove_if(found.begin(),
                                 found.end(),
                                 [&](const Part &c) {
                                   return c.gap < -slave.size;
                                 }),
                  found.end());
    std::vector<Part> parts;
    for (std::size_t c = 0; c < found.size(); ++c)
      {
        const Part          &part = found[c];
        std::vector<Polygon> left = {part.where};
        // Whole outlines are taken away: clipped ones have edges of no length.
        for (std::size_t nearer = 0; nearer < c && !left.empty(); ++nearer)
          left = without(left, found[nearer].projected.outline());
        for (Polygon &piece : left)
          parts.push_back(
            {part.face, part.projected, std::move(piece), part.gap});
      }
    return parts;
  }
} // namespace conetact::pairing
