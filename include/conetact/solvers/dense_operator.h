// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_dense_operator_h
#define conetact_solvers_dense_operator_h

#include "conetact/solvers/linear_operator.h"
#include "conetact/solvers/newton_system.h"

namespace conetact::solvers
{
  /**
   * The relation of a system that has a matrix, in either form. In 2D a step is
   * exact as soon as the states are; in 3D the direction of slip converges
   * quadratically. Keeps factors from step to step.
   */
  class DenseOperator : public LinearOperator
  {
  public:
    using Array = Eigen::VectorXd;

    explicit DenseOperator(std::shared_ptr<const ContactSystem> system);

    /** The load and the laws of an increment. */
    void
    set_load(const ContactProblem &problem)
    {
      numbers.set_load(problem);
    }

    /** Whether friction that varies has its own slopes (linearized_laws()). */
    void
    take_own_slopes(const bool own)
    {
      has_own_slopes = own;
    }

    const LinearRelation &
    relation() const override
    {
      return numbers;
    }
    /** M p + l. */
    Array
    dual(const Array &p) const;
    /** Without sets. */
    NewtonPoint
    point_at(const Array &p) const;

    std::optional<NewtonPoint>
    step(const NodeSets    &sets,
         const NewtonPoint &from,
         const double       precision,
         SolverReport      &report) override;
    std::optional<NewtonPoint>
    forced_step(const NodeSets    &sets,
                const NewtonPoint &from,
                const double       precision,
                SolverReport      &report) override;
    NewtonPoint
    between(const NewtonPoint &from,
            const NewtonPoint &to,
            const double       tau) const override;
    double
    precision(const NewtonPoint    &point,
              const NewtonProgress &progress) const override;
    bool
    is_exact(const NewtonProgress &progress) const override;
    bool
    may_gain(const NewtonPoint    &point,
             const NewtonProgress &progress) const override;
    Patience
    patience() const override;
    void
    write(const NewtonPoint &point, ContactState &state) const override;

  private:
    std::optional<NewtonPoint>
    solve(const NodeSets    &sets,
          const NewtonPoint &from,
          const double       precision,
          const bool         regularised,
          SolverReport      &report);
    /** A point near the solution of its sets, nearer to it by the factors of
     * the step that has led there. */
    NewtonPoint
    corrected(const NodeSets &sets, NewtonPoint point);
    std::vector<NodeLaw>
    laws_at(const NodeSets &sets, const NewtonPoint &point) const;
    bool
    is_balanced(const NewtonPoint &point) const;

    LinearRelation numbers;
    NewtonSystem   newton;
    bool           has_own_slopes = false;
  };
} // namespace conetact::solvers

#endif
