// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_gauss_seidel_h
#define conetact_solvers_gauss_seidel_h

#include "conetact/solvers/contact_solver.h"

#include <memory>

namespace conetact::solvers
{
  /**
   * Nonlinear block Gauss-Seidel: node after node takes the exact solution of
   * its own Coulomb problem while all others are held, until the contact
   * residual is below the tolerance (Jourdan, Alart, Jean 1998). In compliance
   * form the held ones are the reactions, @f$v_i = W_{ii} r_i + q_i@f$; in
   * stiffness form the displacements, @f$K_{ii} v_i = r_i + b_i@f$. It needs
   * no factorisation and no tuning, but many sweeps: the yardstick of this
   * field and a last resort. The iterations of its report are sweeps. Starts
   * from the reactions (compliance) or the displacements (stiffness) of the
   * given state.
   */
  std::unique_ptr<ContactSolver>
  make_gauss_seidel(const SolverOptions &options);
} // namespace conetact::solvers

#endif
