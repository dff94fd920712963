// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_active_set_h
#define conetact_solvers_active_set_h

#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/newton_system.h"

#include <optional>
#include <vector>

/**
 * Semismooth Newton method for @f$z = r - c\,v@f$: node i is open where
 * @f$z_n \le 0@f$, sticks where @f$|z_t| \le \mu z_n@f$, else slips with
 * @f$r_t = \mu r_n z_t/|z_t|@f$ (Alart and Curnier, Comput. Methods Appl. Mech.
 * Engrg. 92 (1991) 353-375), c the mean diagonal stiffness of the node. In 2D
 * a step is exact as soon as the states are; in 3D the direction of slip is
 * linearised exactly. All in the scaled variables of LinearRelation, c = 1.
 */
namespace conetact
{
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

  private:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;

    /** What a node is taken for, and where it slips to. */
    struct Set
    {
      NodeState   state = NodeState::open;
      SmallVector direction; ///< unit, of z_t; zero without friction
      double      ratio = 0; ///< mu z_n / |z_t|, at most 1
    };

    void
    attach(const ContactProblem &problem);
    std::vector<Set>
    first_sets(const ContactState &state) const;
    std::vector<Set>
    sets_of(const Array &p, const Array &d) const;
    std::vector<NodeLaw>
    laws(const std::vector<Set> &sets, const Array &p, const Array &d) const;

    /** Norm of r - P(z), the residual of the law. */
    double
    law_residual(const Array &p, const Array &d) const;

    SolverReport
    run(const ContactProblem &problem,
        Array                &p,
        Array                &d,
        std::vector<Set>     &sets,
        ContactState         &state);
    SolverReport
    iterate(Array &p, Array &d, std::vector<Set> &sets);
    void
    finish(const ContactProblem   &problem,
           const std::vector<Set> &sets,
           Array                  &p,
           Array                  &d,
           ContactState           &state,
           SolverReport           &report) const;

    SolverOptions                 options;
    std::optional<LinearRelation> relation;
    NewtonSystem                  newton;
  };

  std::unique_ptr<ContactSolver>
  make_active_set(const SolverOptions &options);
} // namespace conetact

#endif
