// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_branch_follower_h
#define conetact_analysis_branch_follower_h

#include "conetact/analysis/run_context.h"

#include <vector>

namespace conetact::analysis
{
  /** One of all solutions that are followed. */
  struct Branch
  {
    contact::ContactHistory before, after; ///< of its increment
    AnotherSolution         solution;
    unsigned int            number = 1; ///< among those of its increment
    unsigned int            parent = 1; ///< the same of the one before
  };

  /**
   * Method = all solutions: every solution of each increment, from every one of
   * the increment before. The first branch is the one that is verified and goes
   * on as the run.
   */
  class BranchFollower
  {
  public:
    /** The context must outlive the object. Throws InputError where the scene
     * asks for all solutions of what has no finite number of them. */
    BranchFollower(RunContext &run, const bool contacts_change);

    /** All solutions of a solved increment. Throws AnalysisError. */
    void
    follow(const PendingIncrement        &increment,
           const solvers::ContactProblem &problem);
    /** Those of the last increment. */
    const std::vector<Branch> &
    last() const
    {
      return branches;
    }

  private:
    /** Another branch, unless `next` has it. */
    void
    add(const Branch                  &from,
        const solvers::ContactProblem &problem,
        const solvers::ContactState   &end,
        const PendingIncrement        &increment,
        std::vector<Branch>           &next) const;
    void
    say(const std::vector<Branch> &next,
        const PendingIncrement    &increment,
        const std::string         &open) const;

    RunContext         &run;
    std::vector<Branch> branches, starts; ///< those of the increment before
    unsigned int        number = 0;       ///< of the increment
  };
} // namespace conetact::analysis

#endif
