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
} // namespace conetact::pairing

#endif
