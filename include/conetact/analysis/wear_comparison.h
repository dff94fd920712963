// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_wear_comparison_h
#define conetact_analysis_wear_comparison_h

#include "conetact/analysis/run_context.h"
#include "conetact/analysis/wear_error.h"
#include "conetact/solvers/contact_solver.h"

#include <memory>
#include <optional>

namespace conetact::analysis
{
  /**
   * Solves increments whose wear is accelerated twice more, in a history of its
   * own, to see what half of the acceleration makes of them.
   */
  class WearComparison
  {
  public:
    /** The context must outlive the object. `contacts_change`: from one
     * increment to the next. */
    WearComparison(RunContext &run, const bool contacts_change);

    /**
     * An increment that was accepted. It happens after half of its wear, and
     * once more where that has worn. Contacts that are found again take the
     * places of the run itself.
     */
    void
    add(const PendingIncrement &increment);

    WearError error;

  private:
    /** An increment after `before` with half of what wears; its history, or
     * nothing where it is not solved. */
    std::optional<contact::ContactHistory>
    after_half(contact::ContactHistory before,
               const PendingIncrement &increment);
    /** Bodies have become others for solvers, or free motions have. */
    void
    see_elasticity();

    RunContext                                   &run;
    const bool                                    contacts_change;
    std::shared_ptr<const solvers::ContactSystem> system;
    std::unique_ptr<solvers::ContactSolver>       solver;
    std::optional<contact::ContactHistory>        history; ///< so far
  };
} // namespace conetact::analysis

#endif
