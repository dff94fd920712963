// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_uniqueness_judge_h
#define conetact_analysis_uniqueness_judge_h

#include "conetact/analysis/run_context.h"
#include "conetact/solvers/uniqueness.h"

#include <optional>

namespace conetact::analysis
{
  /** Whether increments have one solution (Output/Uniqueness = yes). */
  class UniquenessJudge
  {
  public:
    /** The context must outlive the object. `contacts_change`: from one
     * increment to the next. */
    UniquenessJudge(RunContext &run, const bool contacts_change);

    /** Writes the verdict to the record of a solved increment and why to the
     * log, and keeps another solution, if one is found. */
    void
    judge(PendingIncrement &increment, const solvers::ContactProblem &problem);

  private:
    /** The check for such cones; a new one where they are not those of before.
     */
    const solvers::UniquenessCheck &
    check_of(const std::shared_ptr<const solvers::ContactSystem> &cones);

    RunContext                             &run;
    const bool                              contacts_change;
    std::optional<solvers::UniquenessCheck> check;
  };
} // namespace conetact::analysis

#endif
