// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_obstacle_table_h
#define conetact_pairing_obstacle_table_h

#include "conetact/pairing/obstacles.h"

namespace conetact::pairing
{
  const std::vector<ObstacleRow> &
  obstacle_table();

  /** Entries of `subsection Obstacle NAME`, of all shapes. */
  void
  declare_obstacle(dealii::ParameterHandler &prm);
  /** `folder`: files of shapes are relative to it. Throws InputError. */
  Obstacle
  create_obstacle(dealii::ParameterHandler    &prm,
                  const std::string           &name,
                  const unsigned int           dim,
                  const std::filesystem::path &folder = {});
} // namespace conetact::pairing

#endif
