// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_smoothing_newton_h
#define conetact_solvers_smoothing_newton_h

#include "conetact/solvers/active_set.h"
#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/smoothing_iteration.h"

#include <optional>

namespace conetact::solvers
{
  /**
   * The smoothing method ([K] (17), see SmoothingIteration) as a solver: it
   * iterates on the numbers of LinearRelation, so that its counts are the same
   * in all units, and ends with an active set step that makes zeros exact.
   */
  class SmoothingNewton : public ContactSolver
  {
  public:
    explicit SmoothingNewton(const SolverOptions &options);

    SolverReport
    solve(const ContactProblem &problem, ContactState &state) override;

  private:
    void
    finish(const ContactProblem &problem,
           ContactState         &state,
           SolverReport         &report);

    SolverOptions                 options;
    ActiveSet                     active_set;
    std::optional<LinearRelation> relation;
  };

  std::unique_ptr<ContactSolver>
  make_smoothing_newton(const SolverOptions &options);
} // namespace conetact::solvers

#endif
