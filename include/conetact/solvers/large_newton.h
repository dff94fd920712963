// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_large_newton_h
#define conetact_solvers_large_newton_h

#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/large_operator.h"
#include "conetact/solvers/semismooth_newton.h"

#include <optional>

namespace conetact::solvers
{
  /**
   * SemismoothNewton on a LargeOperator. Starts where the load leads if it goes
   * on as in the increment before. Where full steps end in a cycle of states
   * they are cut, and their systems solved to the end; where that does not help
   * the increment is solved in parts.
   *
   * Loads of its problems and u of its states are own numbers of the
   * LargeSystem. In between they are where the system keeps them.
   */
  class LargeNewton : public ContactSolver
  {
  public:
    explicit LargeNewton(const SolverOptions &options);

    SolverReport
    solve(const ContactProblem &problem, ContactState &state) override;

  private:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;
    using Kept  = LargeSystem::Kept;

    void
    attach(const ContactProblem &problem);
    SolverReport
    run(const ContactProblem &problem,
        NewtonPoint           point,
        ContactState         &state,
        const bool            exactly);
    std::optional<NewtonPoint>
    predict(const ContactProblem &problem,
            const ContactState   &state,
            const Kept           &u) const;
    /** Whether another backend is to solve the increment after this work. */
    bool
    leaves(const SolverReport &report) const;
    SolverReport
    solve_whole(const ContactProblem &problem, ContactState &state);
    ContactState
    all_stuck(const ContactState &start) const;
    /** Closed where no gap is, or where loads drive bodies that float, and
     * nowhere else. */
    std::vector<NodeState>
    driven_states(const ContactState &start, const Kept &u);
    /** From so much friction that what holds bodies sticks. */
    SolverReport
    solve_with_falling_friction(const ContactProblem &problem,
                                const Kept           &start_u,
                                ContactState         &state);
    SolverReport
    solve_in_parts(const ContactProblem &problem, ContactState &state);
    /** Whether a state, displacements and all, is that of u and r.
     * Displacements may count from another place than last time. */
    bool
    is_at(const ContactState &state,
          const Kept         &of_state,
          const Kept         &u,
          const Array        &r) const;
    void
    remember(const ContactProblem &problem,
             const ContactState   &start,
             const ContactState   &end);

    SolverOptions                options;
    std::optional<LargeOperator> elastic;

    /** The last increment: where it ended, how far it went. */
    struct Last
    {
      Kept  start_u, end_u, end_load;
      Array start_r, end_r;
      Kept  load, u; ///< changes of them
      Array offset;
    };
    std::optional<Last> last;
    /** What came nearest to a solution. */
    std::optional<NewtonPoint> nearest;
  };
} // namespace conetact::solvers

#endif
