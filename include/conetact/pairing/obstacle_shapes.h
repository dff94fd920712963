// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_obstacle_shapes_h
#define conetact_pairing_obstacle_shapes_h

#include "conetact/pairing/obstacles.h"

namespace conetact::pairing
{
  // Rows of obstacle_table(), by the file that has their classes: surfaces
  // without edges; solids with apexes, edges and corners; faces of a file.

  ObstacleRow
  half_space_row();
  ObstacleRow
  prescribed_gap_row();
  ObstacleRow
  sphere_row();
  ObstacleRow
  cylinder_row();
  ObstacleRow
  implicit_row();

  ObstacleRow
  cone_row();
  ObstacleRow
  box_row();

  ObstacleRow
  surface_mesh_row();

  /** How far the facets of a shape stand off a curved surface that they stand
   * for, near a point; 0 for shapes that are exact [length]. */
  double
  sagitta_at(const ObstacleShape &shape, const Point<3> &p);
  /** What a user must know of the file of a shape, a sentence; empty: nothing.
   */
  std::string
  caution_of(const ObstacleShape &shape);
} // namespace conetact::pairing

#endif
