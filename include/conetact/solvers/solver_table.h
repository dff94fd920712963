// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_solver_table_h
#define conetact_solvers_solver_table_h

#include "conetact/solvers/contact_solver.h"

#include <memory>
#include <vector>

namespace conetact::solvers
{
  /** One row for each method a scene may name. */
  struct SolverRow
  {
    const char *name;
    const char *description;
    std::unique_ptr<ContactSolver> (*create)(const SolverOptions &);
  };
  const std::vector<SolverRow> &
  solver_table();

  /** Throws std::invalid_argument for a name that solver_table() has not. */
  std::unique_ptr<ContactSolver>
  make_solver(const SolverOptions &options);
} // namespace conetact::solvers

#endif
