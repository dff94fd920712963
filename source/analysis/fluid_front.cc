// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/fluid_front.h"

#include <utility>

namespace conetact::analysis
{
  FluidFront::FluidFront(RunContext &r)
    : run(r)
  {}

  bool
  FluidFront::advances(PendingIncrement &increment)
  {
    const contact::ContactPoints &points = run.model.points;
    if (!fluid)
      fluid.emplace(run.model.bodies, points);
    if (fluid->is_none())
      return false;
    increment.wet.resize(points.size(), false);
    std::vector<bool> wet =
      fluid->wet(increment.wet, increment.end.r, points, increment.record.time);
    if (wet == increment.wet)
      return false;
    increment.wet = std::move(wet);
    run.set_laws(increment);
    return true;
  }

  void
  FluidFront::say_leaks(const PendingIncrement &increment)
  {
    if (increment.wet.empty())
      return;
    for (const unsigned int contact :
         fluid->leaks(increment.wet, run.model.points))
      if (said.insert(contact).second)
        run.log.note(
          "increment " + std::to_string(increment.record.increment) +
          ": contact '" + run.scene.contact_names[contact] +
          "' leaks: its fluid has reached an edge that is no source of it and "
          "that no support holds");
  }
} // namespace conetact::analysis
