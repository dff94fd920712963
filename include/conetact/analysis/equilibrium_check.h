// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_equilibrium_check_h
#define conetact_analysis_equilibrium_check_h

#include "conetact/analysis/run_context.h"
#include "conetact/solvers/existence.h"

#include <memory>
#include <optional>
#include <string>

namespace conetact::analysis
{
  /**
   * Whether contacts can hold bodies that nothing else holds. All answers are
   * sentences why they cannot, without a full stop; empty: nothing is known
   * against it.
   */
  class EquilibriumCheck
  {
  public:
    /** The context must outlive the object. `contacts_change`: within
     * increments, too. */
    EquilibriumCheck(RunContext &run, const bool contacts_change);

    /** Contacts or free motions have become other ones. */
    void
    reset()
    {
      existence.reset();
    }
    /** Before an increment is solved. */
    std::string
    refusal(const solvers::ContactProblem &problem,
            const PendingIncrement        &increment);
    /** What slips or tips under the part of an increment that its solver has
     * reached; empty: the method has failed otherwise. */
    std::string
    limit(const solvers::ContactProblem &problem,
          const PendingIncrement        &increment) const;
    /** What would slip or tip under a little more load than the increment's;
     * empty: nothing is known. Newton's method may fail so near a limit. */
    std::string
    limit_ahead(const solvers::ContactProblem &problem,
                const PendingIncrement        &increment) const;
    /** Whether so much more of the load than reactions r of all unknowns bear
     * is beyond such a limit. */
    bool
    is_limit(const solvers::ContactProblem &problem,
             const PendingIncrement        &increment,
             const Eigen::VectorXd         &r,
             const double                   more) const;
    /** Before contacts that slide are found: by nodes that are nearest to the
     * other side at its start. */
    std::string
    refusal_where_it_stands(const PendingIncrement &increment);

  private:
    /** By contacts that are active. */
    std::string
    refusal_by_active(const solvers::ContactProblem &problem,
                      const PendingIncrement        &increment);
    /** `ahead`: of so much more load. */
    std::optional<solvers::Existence>
    limit_state(const solvers::ContactProblem &problem,
                const PendingIncrement        &increment,
                const Eigen::VectorXd         &r,
                const double                   ahead = 0) const;
    /** What nodes bear at most where r are the reactions. */
    solvers::Holding
    holding(const PendingIncrement &increment, const Eigen::VectorXd &r) const;
    /** Reactions balance it on the free motions at the start. */
    static Eigen::VectorXd
    load_at_start(const solvers::ContactProblem &problem,
                  const contact::ContactHistory &before);

    RunContext                              &run;
    const bool                               contacts_change;
    std::unique_ptr<solvers::ExistenceCheck> existence; ///< of floating bodies
  };

  /**
   * Leaves bodies on which nothing acts as they are, in the end of an increment
   * that is solved: a system of all bodies is solved to a part of the forces
   * that others have, which is no deformation of these.
   */
  void
  rest_idle_bodies(PendingIncrement &increment, contact::ContactModel &model);
} // namespace conetact::analysis

#endif
