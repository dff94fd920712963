// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_increment_analysis_h
#define conetact_analysis_increment_analysis_h

#include "conetact/analysis/analysis.h"
#include "conetact/analysis/contact_search.h"
#include "conetact/analysis/increment_parts.h"
#include "conetact/analysis/wear_error.h"
#include "conetact/contact/fluid.h"
#include "conetact/contact/open_motions.h"
#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/existence.h"
#include "conetact/solvers/uniqueness.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * The loop over load increments: each is reduced to the contact nodes and
   * solved there; displacements of several are recovered together and checked
   * one by one, those that are not exact enough are corrected.
   */
  class IncrementAnalysis : public Analysis
  {
  public:
    /** Throws InputError. */
    IncrementAnalysis(const application::Scene &scene, Log &log);
    void
    run(const std::filesystem::path &folder, const bool quiet) override;

  private:
    /** What came of increments, and which one is next. */
    struct Step
    {
      enum class Outcome
      {
        accepted,
        corrected, ///< accepted; those after it are to be solved anew
        failed
      };
      Outcome      outcome = Outcome::accepted;
      unsigned int next    = 1;
      std::string  why; ///< it failed, a sentence
    };

    /** Keeps the state after the increments on disk, where that is wanted. */
    void
    save_state(const bool at_end);
    void
    write_checkpoint();
    void
    write_archive() const;
    /** Of what processes have found; throws AnalysisError. */
    static void
    demand_equal(const std::vector<PendingIncrement> &batch,
                 const Eigen::MatrixXd               &w);
    /** Throws Interrupted between increments. */
    void
    stop_if_asked(const unsigned int next);
    void
    restore_state();
    std::size_t
    batch_size(const unsigned int n_finished) const;
    /** Solves increments from `first` on, up to one that fails. */
    Step
    solve_batch(const unsigned int first, std::vector<PendingIncrement> &batch);
    /** Whether a cut is to be locked before increment k. */
    bool
    lock_is_due(const unsigned int k) const;
    void
    lock(const unsigned int k);
    double
    begin(const unsigned int increment) const;
    PendingIncrement
    start(const unsigned int k);
    /** Returns why there is no result; empty: there is. */
    std::string
    solve_contact(PendingIncrement            &increment,
                  const solvers::ContactState &guess);
    /**
     * Finds contacts that slide far where an increment that is solved ends, and
     * solves it again, until they stay. Returns why they do not.
     */
    std::string
    settle(PendingIncrement &increment);
    std::string
    why_unsettled(const ContactSearch::Change &change, const double turn) const;
    /** A node as part of a sentence; empty without one. */
    std::string
    where(const pairing::ContactNode *node) const;
    /** Whether contacts that do not stay are near enough to those at the end,
     * or cutting the increment would not help. */
    bool
    may_take(const output::IncrementRecord &record,
             const pairing::FoundChange    &change) const;
    /** Why the contacts that were found cannot be those; empty: they can. */
    std::string
    passes_through(const output::IncrementRecord &record,
                   const Eigen::VectorXd         &u);
    /** They are taken, and said. */
    void
    say_unsettled(const output::IncrementRecord &record,
                  const pairing::FoundChange    &change);
    /** Contacts of an increment were not found: shall it be cut in parts? */
    bool
    cut(const unsigned int increment);
    double
    duration(const unsigned int increment) const;
    void
    keep(output::IncrementRecord               record,
         std::vector<output::IncrementRecord> &finished);
    std::string
    solve_with(ContactSearch::Found found, PendingIncrement &increment);
    /** The model and the history take contacts. Returns why they cannot, a
     * sentence. */
    std::string
    take(ContactSearch::Found found);
    /** The same; throws AnalysisError. */
    void
    must_take(ContactSearch::Found found);
    std::string
    why_not_held(const solvers::ContactProblem &problem,
                 const PendingIncrement        &increment);
    std::string
    no_equilibrium(const solvers::ContactProblem &problem,
                   const PendingIncrement        &increment);
    std::string
    limit_of(const solvers::ContactProblem &problem,
             const PendingIncrement        &increment);
    /** Why bodies must move from where they stand before increment k, a
     * sentence; empty: that is not known. */
    std::string
    why_it_leaves(const unsigned int k);
    /** Whether a fluid gets to more of its contacts than it was solved with,
     * which it takes from here on. */
    bool
    fluid_enters(PendingIncrement &increment);
    /** Solves the increment again until that is all. */
    void
    let_fluid_in(PendingIncrement            &increment,
                 const solvers::ContactState &guess,
                 solvers::ContactProblem     &problem);
    void
    say_leaks(const PendingIncrement &increment);
    /** Compares the wear of an increment with that of two halves. */
    void
    estimate_wear(const PendingIncrement &increment);
    /** An increment after `before` with half of what wears; its history, or
     * nothing where it is not solved. */
    std::optional<contact::ContactHistory>
    after_half(contact::ContactHistory before,
               const PendingIncrement &increment);
    /** Elasticity or contacts have become others. */
    void
    forget_halves()
    {
      solver_of_halves.reset();
      halves.reset();
    }
    /** How many solutions it has, and another one. */
    void
    judge_uniqueness(PendingIncrement              &increment,
                     const solvers::ContactProblem &problem);
    /** Rows of another solution of an increment that begins with `before`, to
     * be asked for before those of the increment. */
    std::vector<output::ContactRow>
    rows_of_solution(const PendingIncrement        &increment,
                     const contact::ContactHistory &before,
                     const AnotherSolution         &solution);
    /** Throws InputError where the scene asks for all solutions of what has no
     * finite number of them. */
    void
    check_branches() const;
    /** All solutions of the increment, from all of the one before. */
    void
    follow_branches(PendingIncrement              &increment,
                    const solvers::ContactProblem &problem);
    std::vector<output::BranchRows>
    rows_of_branches(const PendingIncrement &increment);
    void
    solve_motions(const solvers::ContactProblem &problem,
                  solvers::ContactState         &state,
                  solvers::SolverReport         &report);
    void
    take_bound(PendingIncrement &increment);
    void
    take_result(PendingIncrement              &increment,
                const solvers::ContactProblem &problem);
    /** What its end leaves open of positions. */
    contact::OpenMotions
    open_motions(const PendingIncrement &increment) const;
    void
    shorten_way(PendingIncrement              &increment,
                const solvers::ContactProblem &problem);
    /** Recovers displacements, checks and writes. */
    Step
    finish(std::vector<PendingIncrement> &batch);
    Eigen::MatrixXd
    deformations(const std::vector<PendingIncrement> &batch);
    /** Prepares another way to solve what is not solved without condensation;
     * false, and in `why`: there is none. */
    bool
    solve_otherwise(std::string &why);
    /** Throws AnalysisError. */
    void
    condense_from_here(const std::string &why);
    Step
    check(PendingIncrement &increment, Eigen::VectorXd w);
    /** Of what contact at nodes does not see. */
    void
    warn_of_nodes(const PendingIncrement &increment, const Eigen::VectorXd &u);
    /** The deformation once more, better; none: no contact solution there. */
    std::optional<Eigen::VectorXd>
    correct(PendingIncrement            &increment,
            const Eigen::VectorXd       &w,
            const verification::Finding &finding);
    std::string
    name(const output::IncrementRecord &record) const override;

    std::unique_ptr<solvers::ContactSolver>  solver;
    std::unique_ptr<solvers::ExistenceCheck> existence; ///< of floating bodies
    std::vector<Branch>                     branches; ///< of the last increment
    ContactSearch                           search;
    std::optional<contact::Fluid>           fluid; ///< once it is asked for
    std::set<unsigned int>                  said_leaks; ///< contacts
    std::optional<solvers::UniquenessCheck> uniqueness;
    WearError                               wear_error;
    /** Of increments that are solved again with what has worn in them. */
    std::unique_ptr<solvers::ContactSolver> solver_of_halves;
    std::optional<contact::ContactHistory>  halves; ///< their history so far
    IncrementParts                          parts;  ///< of the one that is next
    std::vector<double> held_in_stage; ///< nodes, with what they remember
    bool lost_contacts = false;        ///< that slide, in what failed last
    bool unsolved      = false;        ///< what failed last, by its solver
    bool in_parts = false; ///< increments that are too large to be condensed
    bool said_unsettled = false, said_between = false, said_askew = false;
    unsigned int n_saved         = 0; ///< increments before the checkpoint
    std::size_t  n_reaction_rows = 0; ///< of increments on disk
    /** Increments need refinement, or leave positions open. */
    bool one_by_one = false;
    /** What is solved follows an increment that was accepted. */
    bool start_is_known = true;
  };
} // namespace conetact::analysis

#endif
