// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_pending_increment_h
#define conetact_analysis_pending_increment_h

#include "conetact/contact/contact_history.h"
#include "conetact/contact/shared_vector.h"
#include "conetact/output/output.h"

namespace conetact::analysis
{
  /** What an increment was found to have, and the problem that it solves. */
  struct AnotherSolution
  {
    solvers::ContactProblem problem;
    solvers::ContactState   end;
  };

  /** An increment whose displacements are still to be recovered. */
  struct PendingIncrement
  {
    contact::ContactHistory before, after;

    model::IncrementRecord record     = {};
    contact::SharedVector  forces     = {}; ///< nodal loads, all dofs
    contact::SharedVector  mechanical = {}; ///< those without thermal ones
    contact::LoadCase      load       = {};
    solvers::ContactState  state      = {};
    Eigen::VectorXd        contact = {}; ///< displacements of contact unknowns
    Eigen::VectorXd        primal  = {}; ///< as Elasticity::expand() takes it
    Eigen::VectorXd        motions = {}; ///< amounts of the free motions
    Eigen::VectorXd        base    = {}; ///< those that it was solved about
    contact::BoundState    bound   = {}; ///< ties and bilateral contacts
    solvers::ContactState  end     = {}; ///< as the solver left it
    Eigen::VectorXd        thermal = {}; ///< nodal forces, or none
    std::vector<bool>      wet     = {}; ///< candidates; empty: none
    std::shared_ptr<const AnotherSolution> another = {}; ///< or none
  };
} // namespace conetact::analysis

#endif
