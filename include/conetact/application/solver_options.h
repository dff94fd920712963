// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_solver_options_h
#define conetact_application_solver_options_h

#include "conetact/condensed/condenser.h"
#include "conetact/load_path/load_path.h"
#include "conetact/solvers/contact_solver.h"

#include <deal.II/base/parameter_handler.h>

namespace conetact::application
{
  /** How a load parameter is followed instead of increments. */
  struct PathSettings
  {
    bool follows = false; ///< else increments, with SolverOptions::method
    load_path::PathLaw law = load_path::PathLaw::incremental;
  };

  /** How bodies answer to forces on their contact nodes. */
  enum class Backend
  {
    automatic,
    condensed, ///< a dense matrix of contact unknowns
    iterative  ///< linear systems of all unknowns, one by one
  };

  /** Entries of `subsection Solver`. */
  void
  declare_solver(dealii::ParameterHandler &prm);

  /** Throws InputError. */
  solvers::SolverOptions
  create_solver_options(dealii::ParameterHandler &prm);
  /** Whether all solutions are asked for. */
  bool
  follows_branches(const dealii::ParameterHandler &prm);
  const condensed::Condenser &
  chosen_condenser(dealii::ParameterHandler &prm);
  /**
   * Throws InputError where other entries do not go with it. `wants_matrix`: an
   * entry that has the condensed problem written; empty: none.
   */
  Backend
  chosen_backend(dealii::ParameterHandler &prm,
                 const std::string        &wants_matrix);
  PathSettings
  create_path_settings(dealii::ParameterHandler &prm);
} // namespace conetact::application

#endif
