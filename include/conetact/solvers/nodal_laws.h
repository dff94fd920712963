// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_nodal_laws_h
#define conetact_solvers_nodal_laws_h

#include "conetact/solvers/cone.h"

#include <memory>

namespace conetact::solvers
{
  /** How much friction a node has, |r_t| <= value, and how that changes. */
  struct FrictionLimit
  {
    double value    = 0; ///< [force]
    double by_force = 0; ///< with the normal reaction [-]
    double by_slip  = 0; ///< with the slip of the increment [force/length]
    double by_gap   = 0; ///< with the gap, of what is bonded [force/length]
  };

  /**
   * Of friction that differs along both tangents of a node: the limit is an
   * ellipse, |(r_1 / a, a r_2)| <= value of its FrictionLimit, and what slips
   * does so along its normal. Stretched reactions (r_1 / a, a r_2) and slips
   * (a u_1, u_2 / a) have a circle for it, and do the same work.
   */
  struct Aspect
  {
    double value    = 1; ///< a [-]
    double by_force = 0; ///< with the normal reaction [1/force]
    double by_slip  = 0; ///< with the slip of the increment [1/length]
    double by_gap   = 0; ///< with the gap, of what is bonded [1/length]

    /** Slips are multiplied by it, reactions divided. */
    SmallVector
    scale(const Eigen::Index size) const
    {
      SmallVector s = SmallVector::Ones(size);
      if (value != 1)
        s.head(2) << value, 1 / value;
      return s;
    }
  };

  /** How much pull a node bears before it opens, r_n >= -value, or while it
   * does, and how that changes. */
  struct Bond
  {
    double value   = 0; ///< [force]
    double by_slip = 0; ///< with the slip of the increment [force/length]
    double by_gap  = 0; ///< with the gap [force/length]
  };

  /**
   * What gives way between both sides of a node. The law of contact holds for
   * @f$(\Delta u_t + C_t r_t - w_t, g + w)@f$ in place of
   * @f$(\Delta u_t, g)@f$: w is what the layer closes or wears by.
   */
  struct Layer
  {
    double      closing  = 0; ///< w [length]
    double      by_force = 0; ///< its change with the reaction [length/force]
    double      by_slip  = 0; ///< and with the slip of the increment [-]
    double      shear    = 0; ///< C_t [length/force]
    SmallVector sheared;      ///< w_t, C_t r_t at the start; empty: zero

    bool
    is_none() const
    {
      return closing == 0 && by_force == 0 && by_slip == 0 && shear == 0;
    }
  };

  /** (slip, gap) of a node as the law of contact sees it, at a reaction r;
   * layer(r_n, slip) is what gives way there. */
  template <typename LayerAt>
  SmallVector
  see(const LayerAt &layer, SmallVector v, const SmallVector &r)
  {
    const Eigen::Index nt    = v.size() - 1;
    const Layer        first = layer(r(nt), 0.); // shear is linear
    v.head(nt) += first.shear * r.head(nt);
    if (first.sheared.size() > 0)
      v.head(nt) -= first.sheared;
    v(nt) += layer(r(nt), v.head(nt).norm()).closing;
    return v;
  }

  /**
   * Laws of an increment's nodes beyond one coefficient for all increments.
   * @f$|r_t| \le f(r_n, |\Delta u_t|)@f$, and what slips has
   * @f$r_t = -f\,\Delta u_t/|\Delta u_t|@f$: f takes the place of
   * @f$\mu r_n@f$ everywhere, so that no solver needs a cone that is none.
   * f(0, .) = 0. Layers give way under forces alone: closing stays
   * as it is where r_n <= 0.
   *
   * Where a bond @f$b(|\Delta u_t|, g)@f$ holds both sides together, s = r_n +
   * b stands in place of r_n: @f$s \ge 0,\ g \ge 0,\ s g = 0@f$, and f(0, .)
   * may be above 0, so that what opens has friction, too.
   */
  class NodalLaws
  {
  public:
    using Index = Eigen::Index;

    virtual ~NodalLaws() = default;

    /** What does not press, s <= 0, has the slope of s = 0. */
    virtual FrictionLimit
    limit(const Index  node,
          const double s,
          const double slip,
          const double gap) const = 0;
    virtual Layer
    layer(const Index node, const double r_n, const double slip) const = 0;

    /** Arguments as of limit(); slips are true ones, not stretched. */
    virtual Aspect
    aspect(const Index /*node*/,
           const double /*s*/,
           const double /*slip*/,
           const double /*gap*/) const
    {
      return {};
    }
    /** Whether the limit of any node is an ellipse. */
    virtual bool
    has_ellipses() const
    {
      return false;
    }

    /** Whether friction is a coefficient a node, known before anything is
     * solved. */
    virtual bool
    has_cones() const = 0;
    /** Whether anything has a layer. */
    virtual bool
    has_layers() const = 0;

    /** At a gap that is not negative. */
    virtual Bond
    bond(const Index /*node*/,
         const double /*slip*/,
         const double /*gap*/) const
    {
      return {};
    }
    /** Whether a bond holds the node, or friction without pressure. */
    virtual bool
    is_bonded(const Index /*node*/) const
    {
      return false;
    }
    /** Whether that is so of any node, or one is joined. */
    virtual bool
    has_bonds() const
    {
      return false;
    }
    /** Whether both sides of a node do not see each other: r is 0, whatever v.
     * A method without this sees them by their layers, far apart. */
    virtual bool
    is_apart(const Index /*node*/) const
    {
      return false;
    }
    /** Whether both sides of a node stay together whatever the reaction: v, as
     * its layer leaves it, is 0. */
    virtual bool
    is_joined(const Index /*node*/) const
    {
      return false;
    }
  };

  /** The laws of an increment; without any all is a coefficient a node. */
  struct WithLaws
  {
    using Index = Eigen::Index;

    std::shared_ptr<const NodalLaws> laws = {};

    /** Whether all limits are linear in r_n, and do not depend on slips. */
    bool
    has_cones() const
    {
      return !laws || laws->has_cones();
    }
    bool
    has_layers() const
    {
      return laws && laws->has_layers();
    }
    bool
    has_ellipses() const
    {
      return laws && laws->has_ellipses();
    }
    /** Whether a bond, or a fluid, acts at any node, or one is joined. */
    bool
    has_bonds() const
    {
      return laws && laws->has_bonds();
    }
    bool
    is_bonded(const Index node) const
    {
      return laws && laws->is_bonded(node);
    }
    bool
    is_apart(const Index node) const
    {
      return laws && laws->is_apart(node);
    }
    bool
    is_joined(const Index node) const
    {
      return laws && laws->is_joined(node);
    }
  };
} // namespace conetact::solvers

#endif
