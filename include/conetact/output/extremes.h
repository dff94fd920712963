// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_extremes_h
#define conetact_output_extremes_h

#include "conetact/output/output.h"

#include <functional>

namespace conetact::output
{
  /**
   * Where bodies move most, `size(body, node)` being how far [length]. Of nodes
   * that move alike, but for rounding, the first one: a symmetric scene has the
   * same place on every machine.
   */
  model::LargestDisplacement
  largest_displacement(
    const std::vector<const bodies::Structure *> &bodies,
    const std::size_t                             n_bodies,
    const std::function<double(const unsigned int, const unsigned int)> &size);

  /** Where contact presses most. */
  struct LargestPressure
  {
    double       pressure = 0; ///< [stress]; 0: nowhere
    unsigned int contact  = 0;
    Point<3>     position; ///< undeformed
  };
  /** The first of nodes that are pressed alike; ties that pull do not count. */
  LargestPressure
  largest_pressure(const model::IncrementRecord &record);
} // namespace conetact::output

#endif
