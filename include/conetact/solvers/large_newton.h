// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_large_newton_h
#define conetact_solvers_large_newton_h

#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/large_system.h"
#include "conetact/solvers/node_sets.h"

#include <optional>

namespace conetact::solvers
{
  /**
   * The semismooth Newton method of ActiveSet on all unknowns of a LargeSystem:
   * nodes of contact have the same laws, all others their equilibrium. Linear
   * systems are solved as exactly as the step deserves (Eisenstat and Walker,
   * SIAM J. Sci. Comput. 17 (1996) 16-32), the first one well enough to know
   * the states. Starts where the load leads if it goes on as in the increment
   * before. Where full steps end in a cycle of states they are cut, and their
   * systems solved to the end; where that does not help the increment is
   * solved in parts.
   *
   * Loads of its problems and u of its states are those of all unknowns. In
   * between they are where the system keeps them.
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

    /** Of the tolerance: what the iteration aims at. */
    static constexpr double aim = 1e-2;
    /** Of a linear system that is solved to the end. */
    static constexpr double exact = 1e-9;

    /** Where the iteration stands; p and d as in LinearRelation. */
    struct Point
    {
      Kept     u, f; ///< displacements and K u - b, all unknowns
      Array    p, d;
      NodeSets sets;
      double   law = 0, balance = 0; ///< residuals over the scale of forces
      double   scale = 1;            ///< that, over the forces that are there
      double
      residual() const
      {
        return std::hypot(law, balance);
      }
    };
    /** How Newton's method goes about a step. */
    struct Manner
    {
      bool   damped    = false;
      double precision = 1e-3; ///< of the linear system
    };

    void
    attach(const ContactProblem &problem);
    Point
    point_at(Kept u, Kept f) const;
    Point
    point_at(Kept u) const;
    double
    product(const Kept &x, const Kept &y) const;
    double
    norm(const Kept &x) const;
    std::vector<NodeLaw>
    laws(const Point &point, NodeSets sets) const;
    /** What to take nodes for, one after the other, until it holds bodies. */
    std::vector<NodeSets>
    holding_sets(const Point &point) const;
    std::optional<Point>
    step_with(const NodeSets &sets,
              const Point    &point,
              const Manner   &manner,
              SolverReport   &report) const;
    bool
    step(Point &point, const Manner &manner, SolverReport &report);
    std::string
    iterate(Point        &point,
            SolverReport &report,
            const bool    exactly,
            const double  goal);
    SolverReport
    run(const ContactProblem &problem,
        Point                 point,
        ContactState         &state,
        const bool            exactly);
    std::optional<Point>
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

    SolverOptions                      options;
    std::optional<LinearRelation>      relation;
    std::shared_ptr<const LargeSystem> body;
    Kept                               load; ///< b of the problem at hand
    Array                              load_of_contact; ///< that part of it
    double                             force = 0;       ///< scale [force]

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
    std::optional<Point> nearest;
  };
} // namespace conetact::solvers

#endif
