// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/extremes.h"

#include "conetact/output/csv.h"

#include <deal.II/base/exceptions.h>

namespace conetact::output
{
  namespace
  {
    /** What must be larger by more than rounding to be another place. */
    constexpr double more = 1 + 1e-9;
  } // namespace

  model::LargestDisplacement
  largest_displacement(
    const std::vector<const bodies::Structure *> &bodies,
    const std::size_t                             n_bodies,
    const std::function<double(const unsigned int, const unsigned int)> &size)
  {
    AssertIndexRange(n_bodies, bodies.size() + 1);
    model::LargestDisplacement largest;
    for (unsigned int b = 0; b < n_bodies; ++b)
      for (unsigned int i = 0; i < bodies[b]->n_nodes(); ++i)
        if (const double here = size(b, i); here > more * largest.size)
          largest = {here, b, bodies[b]->position(i)};
    return largest;
  }

  LargestPressure
  largest_pressure(const model::IncrementRecord &record)
  {
    const NoiseFloor forces = noise_of_forces(record);
    LargestPressure  largest;
    for (const model::ContactRow &row : record.rows)
      if (!row.master && row.area > 0)
        if (const double here = forces.clean(row.reaction[0]) / row.area;
            here > more * largest.pressure)
          largest = {here, row.contact, row.position};
    return largest;
  }
} // namespace conetact::output
