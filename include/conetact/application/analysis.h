// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_analysis_h
#define conetact_application_analysis_h

#include "conetact/application/acceptance.h"
#include "conetact/application/log.h"
#include "conetact/application/scene.h"
#include "conetact/application/work.h"
#include "conetact/contact/contact_model.h"
#include "conetact/contact/growing_set.h"
#include "conetact/output/output.h"
#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/existence.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace conetact
{
  /**
   * The loop over load increments: loads, condensation, contact solver, the
   * independent check that accepts or rejects, outputs.
   */
  class Analysis
  {
  public:
    /** Throws InputError where a body is not held. */
    Analysis(const Scene &scene, Log &log);
    virtual ~Analysis() = default;

    /** Sizes and what will be skipped, to the log. */
    void
    report();

    /** Memory and time it will take, to the log; nothing is factorised. */
    void
    estimate() const;

    /** Loads and supports at all times. Throws InputError. */
    virtual void
    check_history();

    /**
     * All that may find the scene wrong: its history, condensation. Throws
     * InputError.
     */
    void
    prepare();

    /**
     * Runs all increments; results go to `folder`, which must exist. Throws
     * AnalysisError where an increment has no accepted result: those before
     * it are on disk.
     */
    virtual void
    run(const std::filesystem::path &folder, const bool quiet);

    /** What was done so far. */
    Work
    work() const;

    /** The last increment with its displacements, of adaptive scenes only. */
    const IncrementRecord &
    last_increment() const
    {
      return final_record;
    }

  protected:
    void
    create_outputs(const std::filesystem::path &folder, const bool quiet);
    std::size_t
    batch_size(const unsigned int n_finished) const;
    void
    check_existence(const ContactProblem   &problem,
                    const Eigen::VectorXd  &start,
                    const PendingIncrement &increment);
    PendingIncrement
    solve(const unsigned int k);
    SolverReport
    solve_contact(const Condensation::Load &load, PendingIncrement &increment);
    unsigned int
    finish(std::vector<PendingIncrement> &batch);
    void
    recover(PendingIncrement &increment, const Eigen::VectorXd &u) const;
    std::size_t
    recover_all(std::vector<PendingIncrement> &batch,
                const Eigen::MatrixXd         &u) const;
    void
    extend_set(const Eigen::VectorXd &gaps);
    bool
    condense_all();
    bool
    check(PendingIncrement &increment, Eigen::VectorXd u);
    Eigen::VectorXd
    correct(PendingIncrement      &increment,
            const Eigen::VectorXd &u,
            const Eigen::VectorXd &unbalanced);
    void
    complete(PendingIncrement      &increment,
             const Equilibrium     &e,
             const Eigen::VectorXd &u);
    void
    write(const std::vector<IncrementRecord> &finished);
    /** "Increment 3 of 5", for messages. */
    virtual std::string
    name(const IncrementRecord &record) const;
    [[noreturn]] void
    fail(const IncrementRecord &record, const std::string &why) const;

    const Scene                         &scene;
    Log                                 &log;
    ContactModel                         model;
    NodalLoads                           loads;
    const Eigen::VectorXd                prestress; ///< all dofs [force]
    ContactHistory                       history;
    GrowingSet                           set;
    Acceptance                           acceptance;
    std::unique_ptr<ContactSolver>       solver;
    std::unique_ptr<ExistenceCheck>      existence; ///< of floating bodies
    RunDescription                       description;
    IncrementRecord                      final_record; ///< of adaptive scenes
    std::vector<std::unique_ptr<Output>> outputs;
    Work                                 done;
    unsigned int first_unsure = 0;     ///< increments before the last one
    bool         correcting   = false; ///< increments need refinement
  };

  /** The analysis that the scene's Solver/Method asks for. */
  std::unique_ptr<Analysis>
  make_analysis(const Scene &scene, Log &log);
} // namespace conetact

#endif
