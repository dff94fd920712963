// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_acceptance_h
#define conetact_application_acceptance_h

#include "conetact/application/pending_increment.h"
#include "conetact/application/scene.h"
#include "conetact/contact/contact_rows.h"
#include "conetact/contact/equilibrium.h"

#include <string>

namespace conetact
{
  /**
   * The independent check of increments by the uncondensed equilibrium, and
   * what goes to the tables of those it accepts.
   */
  class Acceptance
  {
  public:
    Acceptance(const Scene &scene, const ContactModel &model);

    /** `u`: displacements of all dofs at the end of the increment. */
    Equilibrium
    judge(const PendingIncrement &increment, const Eigen::VectorXd &u) const;

    /**
     * Completes the record of the increment, with its displacements where
     * these are `drawn`. Returns why it is not accepted, empty where it is.
     * Increments come in their order, each once.
     */
    std::string
    complete(PendingIncrement      &increment,
             const Equilibrium     &e,
             const Eigen::VectorXd &u,
             const bool             drawn);

  private:
    void
    add_resultants(IncrementRecord &record, const Equilibrium &e) const;
    void
    add_displacements(IncrementRecord &record, const Eigen::VectorXd &u) const;

    const Scene        &scene;
    const ContactModel &model;
    ContactRows         contact_rows;
    double largest_force = 0; ///< nodal force of the increments so far [force]
  };
} // namespace conetact

#endif
