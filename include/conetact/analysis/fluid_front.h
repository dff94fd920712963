// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_fluid_front_h
#define conetact_analysis_fluid_front_h

#include "conetact/analysis/run_context.h"
#include "conetact/contact/fluid.h"

#include <optional>
#include <set>

namespace conetact::analysis
{
  /** Fluids that get between the sides of contacts within an increment. */
  class FluidFront
  {
  public:
    /** The context must outlive the object. */
    explicit FluidFront(RunContext &run);

    /**
     * Whether fluids get to more nodes of an increment that is solved than it
     * was solved with. It has their laws from here on. What is wet stays so in
     * the increment.
     */
    bool
    advances(PendingIncrement &increment);
    /** A line to the log for each contact that leaks for the first time. */
    void
    say_leaks(const PendingIncrement &increment);

  private:
    RunContext                   &run;
    std::optional<contact::Fluid> fluid; ///< once it is asked for
    std::set<unsigned int>        said;  ///< contacts that leak
  };
} // namespace conetact::analysis

#endif
