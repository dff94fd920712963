// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_solver_options_h
#define conetact_application_solver_options_h

#include "conetact/solvers/contact_solver.h"

#include <deal.II/base/parameter_handler.h>

namespace conetact
{
  /** Entries of `subsection Solver`. */
  void
  declare_solver(dealii::ParameterHandler &prm);

  /** Throws InputError. */
  SolverOptions
  create_solver_options(dealii::ParameterHandler &prm);
} // namespace conetact

#endif
