// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_obstacle_entries_h
#define conetact_pairing_obstacle_entries_h

#include "conetact/base/points.h"

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace conetact::pairing
{
  // Entries of `subsection Obstacle NAME` that several shapes share, and how
  // they are read. `in` names the obstacle: "Obstacle 'floor', ". All throw
  // InputError.

  void
  declare_normal(dealii::ParameterHandler &prm);
  /** Center, Point, Radius, Axis. */
  void
  declare_round(dealii::ParameterHandler &prm);

  /** Where a shape stands that has axes of its own. */
  void
  declare_shape_placement(dealii::ParameterHandler &prm);

  /** A vector of length 1. */
  Tensor<1, 3>
  unit_vector(dealii::ParameterHandler &prm,
              const std::string        &key,
              const unsigned int        dim,
              const std::string        &in);
  /** A place [length]; empty: the origin. */
  Point<3>
  point(dealii::ParameterHandler &prm,
        const std::string        &key,
        const unsigned int        dim,
        const std::string        &in);
  /** A number above 0. */
  double
  positive(dealii::ParameterHandler &prm,
           const std::string        &key,
           const std::string        &in);
} // namespace conetact::pairing

#endif
