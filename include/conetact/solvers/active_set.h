// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_active_set_h
#define conetact_solvers_active_set_h

#include "conetact/solvers/dense_operator.h"
#include "conetact/solvers/predictor.h"
#include "conetact/solvers/semismooth_newton.h"

#include <limits>
#include <optional>

namespace conetact::solvers
{
  /**
   * SemismoothNewton on a DenseOperator, from the states of the last increment,
   * or from where the load leads if it goes on as before (see Predictor). A
   * load that has not changed takes no step. The zeros of the result are exact.
   */
  class ActiveSet : public ContactSolver
  {
  public:
    explicit ActiveSet(const SolverOptions &options);

    SolverReport
    solve(const ContactProblem &problem, ContactState &state) override;

    /**
     * Starts from an estimate of the end of the increment, whose states are
     * read off @f$r - c\,v@f$, and makes it exact. Fails where the estimate
     * is too far off: the state is then of no use. Takes no more than `most`
     * steps.
     */
    SolverReport
    polish(const ContactProblem &problem,
           ContactState         &state,
           const unsigned int most = std::numeric_limits<unsigned int>::max());

    /** Starts from the states of the nodes, and from nothing else. */
    SolverReport
    solve_from(const ContactProblem &problem, ContactState &state)
    {
      attach(problem);
      return solve_from_states(problem, state);
    }

  private:
    void
    attach(const ContactProblem &problem);
    SolverReport
    unchanged(const ContactProblem &problem, ContactState &state) const;
    SolverReport
    solve_from_states(const ContactProblem &problem, ContactState &state);
    /** From other starts, where that of the increment does not lead to a
     * solution. */
    void
    solve_otherwise(const ContactProblem &problem,
                    const ContactState   &start,
                    ContactState         &state,
                    SolverReport         &report);
    /** From the states, by tangents at the present slips. */
    SolverReport
    solve_with_own_slopes(const ContactProblem &problem, ContactState &state);
    /** Of laws whose friction falls so fast that their slopes lead astray. */
    SolverReport
    solve_without_fall(const ContactProblem &problem, ContactState &state);
    /** Of laws whose friction grows so steeply from rest that no step finds the
     * slip: from gentle ones on. */
    SolverReport
    solve_by_slower_slip(const ContactProblem &problem, ContactState &state);
    SolverReport
    run(const ContactProblem  &problem,
        const Eigen::VectorXd &p,
        NodeSets               sets,
        ContactState          &state,
        const SolverOptions   &by);

    SolverOptions                options;
    std::optional<DenseOperator> system;
    Predictor                    predictor;
  };

  std::unique_ptr<ContactSolver>
  make_active_set(const SolverOptions &options);
} // namespace conetact::solvers

#endif
