// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_settling_h
#define conetact_analysis_settling_h

#include "conetact/analysis/increment_parts.h"
#include "conetact/analysis/increment_solver.h"
#include "conetact/analysis/swinging.h"

#include <string>

namespace conetact::analysis
{
  /**
   * Contacts that slide far, found again where an increment ends until it ends
   * with those that it was solved with.
   */
  class Settling
  {
  public:
    /** All of these must outlive the object. `parts`: of the increment that is
     * settled. */
    Settling(RunContext           &run,
             IncrementSolver      &solver,
             const IncrementParts &parts,
             Swinging             &swinging);

    /** Takes an increment that is solved; solves it again, until its contacts
     * stay. */
    Failure
    settle(PendingIncrement &increment);

  private:
    std::string
    why_unsettled(const ContactSearch::Change &change, const double turn) const;
    /** A node as part of a sentence; empty without one. */
    std::string
    where(const pairing::ContactNode *node) const;
    /** Whether contacts that do not stay are near enough to those at the end,
     * or cutting the increment would not help. */
    bool
    may_take(const model::IncrementRecord &record,
             const pairing::FoundChange   &change) const;
    /** Why the contacts that were found cannot be those; no failure: they can.
     */
    Failure
    passes_through(const model::IncrementRecord &record,
                   const Eigen::VectorXd        &u);
    /** They are taken, and said. */
    void
    say_unsettled(const model::IncrementRecord &record,
                  const pairing::FoundChange   &change);

    RunContext           &run;
    IncrementSolver      &solver;
    const IncrementParts &parts;
    Swinging             &swinging;
    bool                  has_said = false;
  };
} // namespace conetact::analysis

#endif
