// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_large_operator_h
#define conetact_solvers_large_operator_h

#include "conetact/solvers/linear_operator.h"

namespace conetact::solvers
{
  /**
   * The relation of a LargeSystem: nodes of contact have their laws, all other
   * unknowns their equilibrium. Linear systems are solved as exactly as the
   * step deserves (Eisenstat and Walker, SIAM J. Sci. Comput. 17 (1996) 16-32),
   * the first one well enough to know the states. Points are kept where the
   * system computes with them.
   */
  class LargeOperator : public LinearOperator
  {
  public:
    using Array = Eigen::VectorXd;
    using Kept  = LargeSystem::Kept;

    /** Of a linear system that is solved to the end. */
    static constexpr double exact = 1e-9;
    /** Residuals below this that do not improve any more are rounding. */
    static constexpr double noise = 1e-11;

    /** A system with a LargeSystem; `tolerance` is that of residuals. */
    LargeOperator(std::shared_ptr<const ContactSystem> system,
                  const double                         tolerance);

    /** The load and the laws of an increment; loads are own numbers. */
    void
    set_load(const ContactProblem &problem);

    const LinearRelation &
    relation() const override
    {
      return numbers;
    }
    const LargeSystem &
    body() const
    {
      return *numbers.system().large;
    }
    /** b of the load. */
    const Kept &
    load() const
    {
      return whole_load;
    }

    /** At displacements u of all unknowns; without sets. */
    NewtonPoint
    point_at(Kept u) const;
    /** Of all unknowns. */
    double
    product(const Kept &x, const Kept &y) const;
    double
    norm(const Kept &x) const;

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
    NewtonPoint
    refreshed(NewtonPoint point) const override
    {
      return point_at(std::move(point.u));
    }
    double
    precision(const NewtonPoint    &point,
              const NewtonProgress &progress) const override;
    bool
    is_exact(const NewtonProgress & /*progress*/) const override
    {
      return false;
    }
    bool
    may_gain(const NewtonPoint    &point,
             const NewtonProgress &progress) const override;
    Patience
    patience() const override;
    void
    write(const NewtonPoint &point, ContactState &state) const override;

  private:
    NewtonPoint
    point_at(Kept u, Kept f) const;
    /** In the units of forces and displacements. */
    std::vector<NodeLaw>
    laws(const NewtonPoint &point, NodeSets sets) const;

    LinearRelation numbers;
    double         tolerance;
    Kept           whole_load;
    Array          load_of_contact; ///< that part of it
    double         force = 0;       ///< scale [force]
  };
} // namespace conetact::solvers

#endif
