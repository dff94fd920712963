// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_obstacle_motion_h
#define conetact_pairing_obstacle_motion_h

#include "conetact/pairing/obstacles.h"

namespace conetact::pairing
{
  /** Entries that say how an obstacle moves: prescribed, or free with loads. */
  void
  declare_motion(dealii::ParameterHandler &prm);
  /** Reads them. `in` is "Obstacle 'floor', ". Throws InputError. */
  void
  read_motion(dealii::ParameterHandler &prm,
              const unsigned int        dim,
              const std::string        &in,
              Obstacle                 &obstacle);
} // namespace conetact::pairing

#endif
