// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_linear_operator_h
#define conetact_solvers_linear_operator_h

#include "conetact/solvers/large_system.h"
#include "conetact/solvers/node_sets.h"

#include <cmath>
#include <limits>
#include <optional>

namespace conetact::solvers
{
  /** Where Newton's method stands; p and d as in LinearRelation. */
  struct NewtonPoint
  {
    Eigen::VectorXd   p, d;
    NodeSets          sets;
    double            law = 0, balance = 0; ///< over the scale of forces
    double            scale = 1; ///< that, over the forces that are there
    LargeSystem::Kept u, f;      ///< of a LargeOperator: u and K u - b

    double
    residual() const
    {
      return std::hypot(law, balance);
    }
  };

  /** How the iteration has gone so far. */
  struct NewtonProgress
  {
    unsigned int iterations = 0;
    double       goal       = 0; ///< of the residual
    double gain  = 0; ///< of the last step: residual over the one before it
    bool   first = true, damped = false;
    bool   same = false; ///< states are those of the step before

    /** A gain that shows a step to be worth its work. */
    static constexpr double half = .5;
    bool
    has_improved() const
    {
      return gain < half;
    }
  };

  /** When a system is not worth another step. */
  struct Patience
  {
    static constexpr auto forever = std::numeric_limits<unsigned int>::max();

    double noise = 0; ///< smaller residuals that stay are rounding
    /** Steps with the same states that do not halve the residual. */
    unsigned int same_states = forever;
    /** Steps that gain next to nothing, before steps are cut, and after. */
    unsigned int stalls = forever;
    /** Cut steps in a cycle of states. */
    unsigned int cycles = forever;
    /** Whether a cycle of full steps is left to another start. */
    bool leaves_cycles = false;
  };

  /**
   * A linear relation d = M p + l of a contact system, as SemismoothNewton
   * works with it: the layout of its unknowns, points on it, and steps to where
   * linearised laws of the nodes hold. One for systems with a matrix
   * (DenseOperator), one for those that are too large for it (LargeOperator).
   */
  class LinearOperator
  {
  public:
    virtual ~LinearOperator() = default;

    virtual const LinearRelation &
    relation() const = 0;

    /**
     * The end of a full step from a point, without sets: where the laws that
     * the sets make hold, to this relative precision (0: as exactly as can be).
     * Nothing if the sets let a body go, or the result is not finite.
     */
    virtual std::optional<NewtonPoint>
    step(const NodeSets    &sets,
         const NewtonPoint &from,
         const double       precision,
         SolverReport      &report) = 0;
    /** The same where all sets let a body go: with what is left of its motion
     * made small. */
    virtual std::optional<NewtonPoint>
    forced_step(const NodeSets    &sets,
                const NewtonPoint &from,
                const double       precision,
                SolverReport      &report) = 0;

    /** A point between two, without sets: `from` at tau = 0. */
    virtual NewtonPoint
    between(const NewtonPoint &from,
            const NewtonPoint &to,
            const double       tau) const = 0;
    /** The same point without the rounding of sums of steps. */
    virtual NewtonPoint
    refreshed(NewtonPoint point) const
    {
      return point;
    }

    /** Of the linear system of the next step. */
    virtual double
    precision(const NewtonPoint    &point,
              const NewtonProgress &progress) const = 0;
    /** Whether states that stay are the solution, to the last digit. */
    virtual bool
    is_exact(const NewtonProgress &progress) const = 0;
    /** Whether a residual below the goal is worth one more step. */
    virtual bool
    may_gain(const NewtonPoint    &point,
             const NewtonProgress &progress) const = 0;
    virtual Patience
    patience() const = 0;

    /** The state of a point whose zeros are exact, but for states of nodes. */
    virtual void
    write(const NewtonPoint &point, ContactState &state) const = 0;
  };
} // namespace conetact::solvers

#endif
