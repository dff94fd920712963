// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_increment_solver_h
#define conetact_analysis_increment_solver_h

#include "conetact/analysis/branch_follower.h"
#include "conetact/analysis/contact_search.h"
#include "conetact/analysis/equilibrium_check.h"
#include "conetact/analysis/fluid_front.h"
#include "conetact/analysis/uniqueness_judge.h"
#include "conetact/contact/open_motions.h"
#include "conetact/solvers/contact_solver.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /** Why an increment has no solution. */
  struct Failure
  {
    std::string why;              ///< a sentence; empty: it has one
    bool        unsolved = false; ///< its solver has not found it
    bool        is_lost  = false; ///< contacts that slide were not found
    /** It was left, for increments before it wait to be written. */
    bool is_postponed = false;

    explicit operator bool() const
    {
      return !why.empty();
    }
  };

  /**
   * Solves one increment: what acts, the contact problem, what follows from its
   * end. The history of the context goes from the start of the increment to its
   * end. Whether the end is right is not its business.
   */
  class IncrementSolver
  {
  public:
    /** The context must outlive the object. Throws InputError. */
    explicit IncrementSolver(RunContext &run);

    /** Increment k, or the part of it that ends at t, with what acts then.
     * Throws AnalysisError where its contacts cannot be taken. */
    PendingIncrement
    start(const unsigned int k, const double t);
    Failure
    solve(PendingIncrement &increment);
    /** Once more from its start, with contacts that were found at its end. */
    Failure
    solve_with(ContactSearch::Found found, PendingIncrement &increment);
    /** The deformation once more, better; none: no contact solution there. */
    std::optional<Eigen::VectorXd>
    correct(PendingIncrement            &increment,
            const Eigen::VectorXd       &w,
            const verification::Finding &finding);
    /** Other solutions, and all that are followed, to the record. */
    void
    add_other_solutions(PendingIncrement &increment);
    /** What its end leaves open of positions. */
    contact::OpenMotions
    open_motions(const PendingIncrement &increment) const;
    /** What is solved from now on begins where an accepted increment ended, or
     * where one ended that is still to be judged. */
    void
    set_start_known(const bool is_known)
    {
      start_is_known = is_known;
    }
    /** Increments that the fast method does not find are left from now on. */
    void
    set_fast_only(const bool is_fast_only)
    {
      fast_only = is_fast_only;
    }
    /** Whether the last one was such. */
    bool
    was_slow() const
    {
      return is_slow;
    }
    /** Why bodies must move from where they stand before increment k, a
     * sentence; empty: that is not known. */
    std::string
    why_it_leaves(const unsigned int k, const double t);

    /** The model and the history take contacts. Returns why they cannot, a
     * sentence. */
    std::string
    take(ContactSearch::Found found);
    /** The same; throws AnalysisError. */
    void
    must_take(ContactSearch::Found found);
    /** Other motions are free: solvers begin anew. */
    void
    forget();
    /** Increments are solved in parts, for bodies are too large to be
     * condensed. */
    void
    solve_in_parts();
    /** Throws AnalysisError. */
    void
                  condense_from_here(const std::string &why);
    ContactSearch search;
    FluidFront    fluid;

  private:
    std::unique_ptr<solvers::ContactSolver>
    create_solver();
    /** The fast method has not found the increment: it is said, once. Whether
     * it is to be left. */
    bool
    leaves_slow_increment();
    Failure
    solve_from(const solvers::ContactState &guess, PendingIncrement &increment);
    /** By the solver, about motions nearby if it asks for these. */
    void
    find(const solvers::ContactState &guess,
         PendingIncrement            &increment,
         solvers::ContactProblem     &problem);
    /** Solves the increment again until fluids go no further. */
    void
    let_fluid_in(const solvers::ContactState &guess,
                 PendingIncrement            &increment,
                 solvers::ContactProblem     &problem);
    void
    take_result(PendingIncrement              &increment,
                const solvers::ContactProblem &problem);
    void
    take_bound(PendingIncrement &increment);
    /** Any end that open motions lead to is a solution; the shortest way is
     * what is promised. */
    void
    shorten_way(PendingIncrement              &increment,
                const solvers::ContactProblem &problem);
    /** Rows of another solution of an increment that begins with `before`. */
    std::vector<model::ContactRow>
    rows_of(const AnotherSolution         &solution,
            const contact::ContactHistory &before,
            const PendingIncrement        &increment);

    RunContext                             &run;
    std::unique_ptr<solvers::ContactSolver> solver;
    EquilibriumCheck                        equilibrium;
    UniquenessJudge                         uniqueness;
    BranchFollower                          branches;
    /** What is being solved. */
    const solvers::ContactProblem *problem_at_hand   = nullptr;
    const PendingIncrement        *increment_at_hand = nullptr;
    unsigned int slow_increment = 0; ///< the last one that was said to be slow
    bool         is_slow        = false; ///< the increment at hand
    bool         start_is_known = true;
    bool         fast_only      = false;
  };
} // namespace conetact::analysis

#endif
