// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_semismooth_newton_h
#define conetact_solvers_semismooth_newton_h

#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/linear_operator.h"

#include <optional>
#include <string>

namespace conetact::solvers
{
  /**
   * Semismooth Newton method of Alart and Curnier (see NodeSets) on a
   * LinearOperator, from a point on. Steps are full ones. Where all nodes that
   * hold a body slip the strongest one sticks, or all of them if that is not
   * enough, until they are seen to slip with something left that holds. Where
   * states come again without gain, or nothing is gained for long, steps are
   * cut to what reduces the residual; where that does not help either the
   * iteration says so.
   */
  class SemismoothNewton
  {
  public:
    /** Both must live longer. */
    SemismoothNewton(LinearOperator &of, const SolverOptions &solver_options)
      : system(of)
      , options(solver_options)
    {}

    /** What an iteration aims at. */
    struct Aim
    {
      double goal      = 0; ///< residual that ends it
      double tolerance = 0; ///< residual that is enough, where no step gains
      bool   damped    = false; ///< from the first step on
    };

    /** The reason for failure; empty if the law holds. */
    std::string
    iterate(NewtonPoint &point, SolverReport &report, const Aim &aim) const;

    /**
     * Iterates to the tolerance of the options, and takes the measure of what
     * is found: the state is that of the point, its zeros exact.
     */
    SolverReport
    run(const ContactProblem &problem,
        NewtonPoint          &point,
        ContactState         &state,
        const Aim            &aim) const;

    /** One step; false if there is none. */
    bool
    step(NewtonPoint          &point,
         const NewtonProgress &progress,
         SolverReport         &report) const;

  private:
    std::optional<NewtonPoint>
    full_step(const NewtonPoint &point,
              const double       precision,
              SolverReport      &report) const;
    std::optional<NewtonPoint>
    holding_step(const NodeSets    &sets,
                 const NewtonPoint &point,
                 const double       precision,
                 SolverReport      &report) const;
    std::optional<NewtonPoint>
    first_turned_step(const NewtonPoint &point,
                      const double       precision,
                      SolverReport      &report) const;
    NewtonPoint
    shortened(const NewtonPoint &from, NewtonPoint to) const;

    LinearOperator      &system;
    const SolverOptions &options;
  };
} // namespace conetact::solvers

#endif
