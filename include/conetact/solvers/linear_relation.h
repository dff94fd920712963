// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_linear_relation_h
#define conetact_solvers_linear_relation_h

#include "conetact/solvers/contact_problem.h"

namespace conetact::solvers
{
  /** What displacements of a node are multiplied by, as the law of contact sees
   * them: 1 over the compliance of the node with its layer. */
  struct Step
  {
    double along  = 1; ///< tangents
    double normal = 1;

    SmallVector
    of(const Eigen::Index size) const
    {
      SmallVector s = SmallVector::Constant(size, along);
      s(size - 1)   = normal;
      return s;
    }
  };

  /**
   * Both forms of a ContactProblem as one linear relation without units,
   * @f[ d = M p + l, @f]
   * in which p is the elastic displacement u and d the reaction (stiffness
   * form), or p the reaction and d the displacement v, with the motions and
   * their imbalance behind them (compliance form). Node by node, displacements
   * are divided by @f$\alpha/\sqrt{c_i}@f$ and reactions by
   * @f$\alpha\sqrt{c_i}@f$, where @f$c_i = tr K_{ii} / dim@f$ is the stiffness
   * of node i and @f$\alpha@f$ makes the largest load 1. Tangents and normal of
   * a node are scaled alike, so the law of friction keeps its form; every
   * diagonal block of M has mean 1. Motions are scaled so that their columns of
   * M have norm 1.
   */
  class LinearRelation : public WithLaws
  {
  public:
    using Array = Eigen::VectorXd;

    /**
     * The node scales; reads the diagonal of the matrix only. Unscaled, the
     * numbers stay those of the problem.
     */
    explicit LinearRelation(std::shared_ptr<const ContactSystem> system,
                            const bool                           scaled = true);

    /** Takes the load of an increment and the scale @f$\alpha@f$ with it. */
    void
    set_load(const ContactProblem &problem);

    const ContactSystem &
    system() const
    {
      return *contact_system;
    }
    bool
    is(const std::shared_ptr<const ContactSystem> &other) const
    {
      return contact_system == other;
    }
    bool
    stiffness() const
    {
      return contact_system->form == Form::stiffness;
    }

    /** What displacements and reactions of node i are divided by. */
    double
    unit_of_length(const Index i) const
    {
      const double s = scale(contact_system->first[i]);
      return stiffness() ? alpha * s : alpha / s;
    }
    double
    unit_of_force(const Index i) const
    {
      const double s = scale(contact_system->first[i]);
      return stiffness() ? alpha / s : alpha * s;
    }

    /** Of node i, at a reaction, a slip and a gap in scaled variables, as the
     * law sees them, and so is the result. */
    FrictionLimit
    limit(const Index  i,
          const double r_n,
          const double slip,
          const double gap) const;
    /** Of its limit there, 1 where that is a circle. */
    Aspect
    aspect(const Index  i,
           const double r_n,
           const double slip,
           const double gap) const;
    /** Of node i, as limit(). */
    Bond
    bond(const Index i, const double slip, const double gap) const;
    /** What the law sees of r at v, of which it sees what is given. */
    Array
    add_bonds(const Array &r, const Array &v) const;
    /** What the law sees of v, times step(i), so that it is no larger than what
     * reactions change. Slips and gaps of limit(), aspect() and bond() are
     * such. */
    void
    add_layers(const Array &r, Array &v) const;
    /** Of node i; 1 without a layer. */
    Step
    step(const Index i) const
    {
      return has_layers() ? steps[static_cast<std::size_t>(i)] : Step();
    }
    /** What gives way at node i, at a reaction and a slip in scaled variables.
     */
    Layer
    layer(const Index i, const double r_n, const double slip) const;

    /** The constant part l. */
    const Array &
    load() const
    {
      return scaled_load;
    }

    /** y += M x. Columns where x is zero cost nothing. */
    void
    multiply_add(const Array &x, Array &y) const;

    /** Column scale of M; its row scale is the inverse. */
    const Array &
    column_scale() const
    {
      return scale;
    }

    /** @f$\alpha@f$ [sqrt(force x length)]. */
    double
    unit() const
    {
      return alpha;
    }

    /** Displacements v, with the offset of the stiffness form. */
    Array
    displacements(const Array &p, const Array &d) const;
    const Array &
    reactions(const Array &p, const Array &d) const
    {
      return stiffness() ? d : p;
    }
    /** The offset o, zero in compliance form. */
    const Array &
    offset() const
    {
      return scaled_offset;
    }

    /**
     * What displacements v are known to at p, in compliance form; as in
     * contact_residual().
     */
    Array
    rounding(const Array &p) const;

    /**
     * A force that residuals may be compared with: of reactions p or d, loads
     * and the history.
     */
    double
    force_scale(const Array &p, const Array &d) const;

    /** State with units to (p, d) without, and back. */
    void
    to_scaled(const ContactState &state, Array &p, Array &d) const;
    void
    from_scaled(const Array &p, const Array &d, ContactState &state) const;

  private:
    std::shared_ptr<const ContactSystem> contact_system;
    bool                                 has_units;
    Array             scale; ///< 1/sqrt(c) (stiffness) or sqrt(c) (compliance)
    double            alpha = 1; ///< sqrt(force x length)
    Array             scaled_load, scaled_offset;
    std::vector<Step> steps; ///< of each node, where there are layers
    bool              has_offset = false;
    double load_force = 0; ///< that is known before anything is solved
  };

  /** Whether node i has no friction, neither where nothing presses it nor
   * where all of the load does: what is pulled by a bond may have none, and
   * coefficients may rise from 0 with pressure or with speed. */
  bool
  is_frictionless(const LinearRelation &relation, const Eigen::Index i);
} // namespace conetact::solvers

#endif
