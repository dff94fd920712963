// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_clipping_h
#define conetact_pairing_clipping_h

#include "conetact/base/points.h"

#include <vector>

namespace conetact::pairing
{
  /**
   * Convex polygons in a plane, anticlockwise, and intervals of its first
   * axis (two points, the lower one first): what faces of bodies in space and
   * in the plane become when they are projected. Areas and lengths in units of
   * the coordinates.
   */
  using Polygon = std::vector<Point<2>>;

  /** Anticlockwise, intervals upwards; without edges of no length. */
  Polygon
  oriented(Polygon polygon);

  /** Area of a polygon, length of an interval; 0 if empty. */
  double
  measure(const Polygon &polygon);

  /** Mean of the corners; inside, because polygons are convex. */
  Point<2>
  middle(const Polygon &polygon);

  /** The common part (Sutherland, Hodgman, CACM 17 (1974) 32-42); may be empty.
   */
  Polygon
  common_part(const Polygon &one, const Polygon &other);

  /** What is left of polygons without another one, in convex pieces. */
  std::vector<Polygon>
  without(const std::vector<Polygon> &polygons, const Polygon &taken);

  /** Distance of a point; 0 inside. */
  double
  distance(const Polygon &polygon, const Point<2> &p);

  /** Whether the boxes around both have a common part larger than rounding. */
  bool
  boxes_overlap(const Polygon &one, const Polygon &other);

  /** A point of a polygon and the part of its measure that it stands for. */
  struct PlanePoint
  {
    Point<2> position;
    double   weight;
  };
  /**
   * Gauss points of a polygon as a fan of triangles, on an interval three.
   * Exact for polynomials of degree 5 at level 0, of degree 13 at level 1,
   * which each further level takes on quarters of the triangles.
   */
  std::vector<PlanePoint>
  gauss_points(const Polygon &polygon, const unsigned int level);
} // namespace conetact::pairing

#endif
