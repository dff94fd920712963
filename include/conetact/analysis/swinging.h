// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_swinging_h
#define conetact_analysis_swinging_h

#include "conetact/analysis/run_context.h"

#include <Eigen/Core>

namespace conetact::analysis
{
  /**
   * Bodies that hang on a few nodes, such as a ring on a pin: a turn changes
   * the moment of their load, and they swing until it pulls straight. Where
   * they are placed again and again until they stay, this moment resists the
   * turns (contact::geometric_stiffness()); once they stay it takes no part.
   */
  class Swinging
  {
  public:
    /** The context must outlive the object. */
    explicit Swinging(RunContext &run);

    /** Whether a body may hang, by the loads of an increment. */
    bool
    may_help(const PendingIncrement &increment) const;
    /** Loads resist turns in increments that start from now on. */
    void
    begin(const PendingIncrement &increment);
    /** They do not any more. */
    void
    stop();
    bool
    is_on() const
    {
      return run.model.motions.has_geometric();
    }
    /** Forces at the end of a pass with deformation w resist turns from there.
     */
    void
    go_on(const PendingIncrement &increment, const Eigen::VectorXd &w);
    /** Whether an increment is in balance without this resistance. */
    bool
    is_over(const PendingIncrement &increment) const;

  private:
    RunContext &run;
  };
} // namespace conetact::analysis

#endif
