// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_fixed_cones_h
#define conetact_solvers_fixed_cones_h

#include "conetact/solvers/contact_solver.h"

#include <memory>

namespace conetact::solvers
{
  /**
   * Lets a method that knows one coefficient a node solve increments whose
   * friction varies: with the coefficients of the last solution, until they
   * are those of the solution.
   */
  std::unique_ptr<ContactSolver>
  with_fixed_cones(std::unique_ptr<ContactSolver> method,
                   const SolverOptions           &options);
} // namespace conetact::solvers

#endif
