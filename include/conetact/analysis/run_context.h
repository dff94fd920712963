// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_run_context_h
#define conetact_analysis_run_context_h

#include "conetact/analysis/acceptance.h"
#include "conetact/analysis/backend_table.h"
#include "conetact/analysis/work.h"
#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/contact/contact_history.h"

#include <memory>
#include <string>

namespace conetact::analysis
{
  /**
   * What all parts of a run work with: the scene, its contact model and loads,
   * the history of its contacts, the independent check that accepts or rejects.
   */
  struct RunContext
  {
    /** The scene and the log must outlive the object. Throws InputError. */
    RunContext(const application::Scene &scene, Log &log);

    /** Condensed bodies or levels, with a word to the log. Throws InputError.
     */
    void
    make_elasticity();
    /** Loads and prestress at the increment's time, and what they reduce to. */
    void
    apply_loads(PendingIncrement &increment);
    /** Laws of contacts in an increment that begins with this history. */
    std::shared_ptr<const contact::IncrementLaws>
    laws_from(const contact::ContactHistory &before,
              const PendingIncrement        &increment) const;
    /** Those of its contacts, with what is wet in it. */
    void
    set_laws(PendingIncrement &increment);
    /** Where increment k begins. */
    double
    begin(const unsigned int k) const;
    double
    duration(const unsigned int k) const;
    /** "Increment 3 of 5", for messages. */
    std::string
    increment_name(const model::IncrementRecord &record) const;

    const application::Scene &scene;
    Log                      &log;
    contact::ContactModel     model;
    bodies::NodalLoads        loads;
    const Eigen::VectorXd     prestress; ///< all dofs [force]
    const Backend            *backend;
    contact::ContactHistory   history;
    Acceptance                acceptance;
    Work                      done;

  private:
    /** What acts at time t: all of it, and what is mechanical. */
    void
    take_loads(const double t, PendingIncrement &increment);
    Eigen::VectorXd
    in_frame(const bodies::Load    &load,
             const Eigen::VectorXd &undeformed,
             const double           t) const;
    void
    turn_loads(const Eigen::VectorXd &others, PendingIncrement &increment);
  };
} // namespace conetact::analysis

#endif
