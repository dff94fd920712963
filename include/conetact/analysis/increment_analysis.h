// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_increment_analysis_h
#define conetact_analysis_increment_analysis_h

#include "conetact/analysis/analysis.h"
#include "conetact/analysis/between_nodes.h"
#include "conetact/analysis/increment_parts.h"
#include "conetact/analysis/increment_solver.h"
#include "conetact/analysis/settling.h"
#include "conetact/analysis/wear_comparison.h"

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
    /** Also the laws of contacts in the first increment. */
    void
    check_history() override;
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
      Failure      failure = {};
    };

    std::size_t
    batch_size(const unsigned int n_finished) const;
    /** Solves increments from `first` on, up to one that fails. */
    Step
    solve_batch(const unsigned int first, std::vector<PendingIncrement> &batch);
    /** From where the one before it ends. */
    Failure
    solve_next(PendingIncrement &increment);
    Failure
    solve_and_settle(PendingIncrement &increment);
    /** A failure that condensing the bodies may mend is an unsolved one. */
    Failure
    once_condensed(Failure failure, const PendingIncrement &increment) const;
    /** Whether a cut is to be locked before increment k. */
    bool
    lock_is_due(const unsigned int k) const;
    /** Other motions are free from here on. */
    void
    lock(const unsigned int k);
    /** Recovers displacements, checks and writes. */
    Step
    finish(std::vector<PendingIncrement> &batch);
    /** Of each, the deformation of all dofs: the same on all processes. */
    std::vector<Eigen::VectorXd>
    deformations(const std::vector<PendingIncrement> &batch);
    Step
    check(PendingIncrement &increment, contact::SharedVector w);
    /** Corrects it, and its deformation w, while that helps. Whether it did. */
    bool
    correct(PendingIncrement      &increment,
            verification::Finding &finding,
            contact::SharedVector &w);
    /** Of what contact at nodes does not see. */
    void
    warn_of_nodes(const PendingIncrement &increment, const Eigen::VectorXd &u);
    void
    keep(PendingIncrement                    &increment,
         std::vector<model::IncrementRecord> &finished);

    /** Prepares another way to increment k, which has failed; throws
     * AnalysisError where there is none. */
    void
    go_on_otherwise(const unsigned int k, Failure failure);
    /** Solves what is not solved without condensation another way; false, and
     * in `why`: there is none. */
    bool
    solve_otherwise(Failure &failure);
    /** Cuts it in parts; false: it is not to be cut. */
    bool
    cut(const unsigned int k, const Failure &failure);

    /** Keeps the state after the increments on disk, where that is wanted. */
    void
    save_state(const bool at_end);
    void
    write_checkpoint();
    void
    write_archive(const Eigen::VectorXd &elastic_start) const;
    void
    restore_state();
    /** Throws Interrupted between increments. */
    void
    stop_if_asked(const unsigned int next);
    [[noreturn]] void
    stop();
    /** What is on disk and how to go on, a sentence. */
    std::string
    interrupted() const;
    std::string
    name(const model::IncrementRecord &record) const override;

    IncrementParts      parts; ///< of the one that is next
    IncrementSolver     solver;
    Swinging            swinging;
    Settling            settling;
    BetweenNodes        between;
    WearComparison      wear;
    std::vector<double> held_in_stage; ///< nodes, with what they remember
    bool in_parts = false; ///< increments that are too large to be condensed
    bool said_between = false, said_askew = false;
    unsigned int n_saved         = 0; ///< increments before the checkpoint
    std::size_t  n_reaction_rows = 0; ///< of increments on disk
    /** Increments need refinement, or leave positions open. */
    bool one_by_one = false;
  };
} // namespace conetact::analysis

#endif
