// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_analysis_h
#define conetact_application_analysis_h

#include "conetact/application/log.h"
#include "conetact/application/scene.h"
#include "conetact/application/work.h"
#include "conetact/contact/contact_model.h"
#include "conetact/contact/contact_rows.h"
#include "conetact/contact/equilibrium.h"
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
    /** An increment whose displacements are still to be recovered. */
    struct Pending
    {
      IncrementRecord    record;
      Eigen::VectorXd    forces; ///< nodal loads, all dofs
      Condensation::Load load;
      ContactState       state;
      Eigen::VectorXd    contact; ///< displacements of contact unknowns
      ContactHistory     before, after;
      ContactState       end; ///< of the working set alone
    };
    /** Throws InputError for a contact none of whose nodes may touch. */
    void
    refuse_empty_contacts() const;
    void
    choose_working_set();
    void
    create_outputs(const std::filesystem::path &folder, const bool quiet);
    void
    note_skips();
    std::size_t
    batch_size(const unsigned int n_finished) const;
    void
    check_existence(const ContactProblem  &problem,
                    const Eigen::VectorXd &start,
                    const Pending         &increment);
    Pending
    solve(const unsigned int k);
    SolverReport
    solve_contact(const Condensation::Load &load, Pending &increment);
    unsigned int
    finish(std::vector<Pending> &batch);
    void
    recover(Pending &increment, const Eigen::VectorXd &u) const;
    std::size_t
    recover_all(std::vector<Pending> &batch, const Eigen::MatrixXd &u) const;
    void
    extend_set(const Eigen::VectorXd &gaps);
    bool
    condense_all();
    bool
    check(Pending &increment, Eigen::VectorXd u);
    Equilibrium
    judge(const Pending &increment, const Eigen::VectorXd &u) const;
    Eigen::VectorXd
    correct(Pending               &increment,
            const Eigen::VectorXd &u,
            const Eigen::VectorXd &unbalanced);
    void
    complete(IncrementRecord       &record,
             const Equilibrium     &e,
             const Pending         &increment,
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
    ContactRows                          contact_rows;
    std::unique_ptr<ContactSolver>       solver;
    std::unique_ptr<ExistenceCheck>      existence; ///< of floating bodies
    RunDescription                       description;
    IncrementRecord                      final_record; ///< of adaptive scenes
    std::vector<std::unique_ptr<Output>> outputs;
    Work                                 done;
    std::size_t  n_first_condensed = 0;     ///< contact nodes, at the start
    unsigned int n_extensions      = 0;     ///< of the working set
    unsigned int first_unsure      = 0;     ///< increments before the last one
    bool         correcting        = false; ///< increments need refinement
    double largest_force = 0; ///< nodal force of the increments so far [force]
  };

  /** The analysis that the scene's Solver/Method asks for. */
  std::unique_ptr<Analysis>
  make_analysis(const Scene &scene, Log &log);
} // namespace conetact

#endif
