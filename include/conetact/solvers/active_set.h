// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_active_set_h
#define conetact_solvers_active_set_h

#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/newton_system.h"
#include "conetact/solvers/node_sets.h"
#include "conetact/solvers/predictor.h"

#include <optional>

namespace conetact::solvers
{
  /**
   * Semismooth Newton method of Alart and Curnier (see NodeSets) with full
   * steps, from the states of the last increment, or from where the load leads
   * if it goes on as before (see Predictor). A load that has not changed takes
   * no step. In 2D a step is exact as soon as the states are; in 3D the
   * direction of slip converges quadratically. Where state sets come again the
   * step is cut to what reduces the residual, and where that does not help
   * either the report says so. The zeros of the result are exact.
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
     * is too far off: the state is then of no use.
     */
    SolverReport
    polish(const ContactProblem &problem, ContactState &state);

    /** Starts from the states of the nodes, and from nothing else. */
    SolverReport
    solve_from(const ContactProblem &problem, ContactState &state)
    {
      attach(problem);
      return solve_from_states(problem, state);
    }

  private:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;

    /** Where the iteration stands; p and d as in LinearRelation. */
    struct Point
    {
      Array    p, d;
      NodeSets sets;
      double   residual = 0;
    };

    void
    attach(const ContactProblem &problem);
    SolverReport
    unchanged(const ContactProblem &problem, ContactState &state) const;
    SolverReport
    solve_from_states(const ContactProblem &problem, ContactState &state);
    /** Of laws whose friction falls so fast that their slopes lead astray. */
    SolverReport
    solve_without_fall(const ContactProblem &problem, ContactState &state);
    /** d = M p + l. */
    Array
    dual(const Array &p) const;
    Point
    point_at(const Array &p) const;
    SolverReport
    run(const ContactProblem &problem, Point &point, ContactState &state);
    /** The reason for failure; empty if the law holds. */
    std::string
    iterate(Point &point, SolverReport &report);
    bool
    is_balanced(const Array &p) const;
    bool
    direction(const Point &point, const double precision, Array &dp);
    bool
    step(Point &point, const bool damped, const double goal, const bool exact);

    SolverOptions                 options;
    std::optional<LinearRelation> relation;
    NewtonSystem                  newton;
    Predictor                     predictor;
  };

  std::unique_ptr<ContactSolver>
  make_active_set(const SolverOptions &options);
} // namespace conetact::solvers

#endif
