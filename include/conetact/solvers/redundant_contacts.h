// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_redundant_contacts_h
#define conetact_solvers_redundant_contacts_h

#include "conetact/solvers/contact_solver.h"

#include <memory>

namespace conetact::solvers
{
  /**
   * Contacts of many rigid bodies, in compliance form: W is sparse, of low
   * rank, and perhaps not symmetric. Estimates come from a few sweeps of
   * Gauss-Seidel, then from interior points (see InteriorPoint), at last from
   * many sweeps; each is made exact by ProximalNewton. The first that satisfies
   * the measure ends the search.
   */
  std::unique_ptr<ContactSolver>
  make_redundant_contacts(const SolverOptions &options);

  /** Whether contacts know only their neighbours: W with few entries. */
  bool
  is_sparse_compliance(const ContactSystem &system);
} // namespace conetact::solvers

#endif
