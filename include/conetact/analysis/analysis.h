// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_analysis_h
#define conetact_analysis_analysis_h

#include "conetact/analysis/contact_notices.h"
#include "conetact/analysis/run_context.h"
#include "conetact/output/output.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace conetact::analysis
{
  /**
   * What all analyses of a scene do alike: they check it, write what was
   * accepted, and say how it went.
   */
  class Analysis : protected RunContext
  {
  public:
    /** Throws InputError where a body is not held. */
    Analysis(const application::Scene &scene, Log &log);
    virtual ~Analysis() = default;

    /** Sizes and what will be skipped, to the log. */
    void
    report() const;

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
    virtual void
    prepare();

    /** Condenses once more by another solver. Throws AnalysisError. */
    void
    verify();

    /**
     * Runs all increments; results go to `folder`, which must exist. Throws
     * AnalysisError where an increment has no accepted result: those before
     * it are on disk.
     */
    virtual void
    run(const std::filesystem::path &folder, const bool quiet) = 0;

    /** The last increment on disk in ten lines, to log and screen. */
    void
    say_closing() const;
    bool
    has_results() const
    {
      return !closing_lines.empty();
    }

    /**
     * Contacts that need finite sliding after all, by number, and why: run()
     * has stopped there, and the scene is to be run with them anew. Empty: all
     * increments are done.
     */
    const std::map<unsigned int, std::string> &
    leaves_small() const
    {
      return acceptance.leaves_small();
    }

    /** Processes of the run that share its work. */
    int
    useful_processes() const
    {
      return backend->useful_processes(scene, model);
    }

    /** What was done so far. */
    Work
    work() const;

    /** The last increment with its displacements, of adaptive scenes only. */
    const model::IncrementRecord &
    last_increment() const
    {
      return final_record;
    }

  protected:
    /** Throws InputError where loads drive a body that nothing can hold. */
    void
    refuse_unbalanced(const Eigen::VectorXd &forces, const double t) const;
    /** `n_increments` is 0 where it is not known beforehand. */
    void
    create_outputs(const std::filesystem::path &folder,
                   const std::size_t            n_increments,
                   const bool                   quiet);
    void
    for_outputs(const std::function<void(output::Output &)> &f);
    /** Increments whose displacements are recovered together. */
    std::size_t
    most_at_once() const;
    /** Its record. Returns why it is not accepted; empty: it is. */
    std::string
    complete(PendingIncrement            &increment,
             const verification::Finding &finding,
             const contact::SharedVector &w);
    void
    write(const std::vector<model::IncrementRecord> &finished);
    /** "Increment 3 of 5", for messages. */
    virtual std::string
    name(const model::IncrementRecord &record) const = 0;
    /** Why there is no result, as a sentence. */
    std::string
    failed(const model::IncrementRecord &record, const std::string &why) const;

    ContactNotices           notices;
    output::RunDescription   description;
    model::IncrementRecord   final_record;  ///< of adaptive scenes
    std::vector<std::string> closing_lines; ///< of the last increment
    unsigned int             n_on_disk = 0; ///< increments
    /** Null: those of the first process. */
    std::vector<std::unique_ptr<output::Output>> outputs;
  };
} // namespace conetact::analysis

#endif
