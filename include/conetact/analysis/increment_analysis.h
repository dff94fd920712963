// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_increment_analysis_h
#define conetact_analysis_increment_analysis_h

#include "conetact/analysis/analysis.h"
#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/existence.h"

#include <memory>
#include <string>
#include <vector>

namespace conetact
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
    IncrementAnalysis(const Scene &scene, Log &log);
    void
    run(const std::filesystem::path &folder, const bool quiet) override;

  private:
    std::size_t
    batch_size(const unsigned int n_finished) const;
    void
    check_existence(const ContactProblem   &problem,
                    const PendingIncrement &increment);
    PendingIncrement
    solve(const unsigned int k);
    SolverReport
    solve_contact(PendingIncrement &increment, const ContactState &guess);
    unsigned int
    finish(std::vector<PendingIncrement> &batch);
    void
    recover(PendingIncrement &increment, const Eigen::VectorXd &w) const;
    std::size_t
    recover_all(std::vector<PendingIncrement> &batch,
                const Eigen::MatrixXd         &w) const;
    void
    extend_set(const Eigen::VectorXd &gaps);
    bool
    condense_all();
    bool
    check(PendingIncrement &increment, Eigen::VectorXd w);
    Eigen::VectorXd
    correct(PendingIncrement      &increment,
            const Eigen::VectorXd &w,
            const Finding         &finding);
    std::string
    name(const IncrementRecord &record) const override;

    std::unique_ptr<ContactSolver>  solver;
    std::unique_ptr<ExistenceCheck> existence; ///< of floating bodies
    unsigned int first_unsure = 0;     ///< increments before the last one
    bool         correcting   = false; ///< increments need refinement
  };
} // namespace conetact

#endif
