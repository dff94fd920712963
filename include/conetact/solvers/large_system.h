// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_large_system_h
#define conetact_solvers_large_system_h

#include "conetact/solvers/node_law.h"

#include <memory>
#include <optional>
#include <vector>

namespace conetact::solvers
{
  /** Numbers for all unknowns of a LargeSystem, where that has them. */
  class LargeVector
  {
  public:
    virtual ~LargeVector() = default;
  };

  /**
   * An elastic system @f$K u = b + H^T r@f$ in all its unknowns, too large to
   * be condensed: the unknowns of contact are the last ones of u, as a
   * ContactSystem numbers them, K is symmetric and positive semidefinite. It
   * does the linear algebra of a Newton step as NewtonSystem does that of
   * condensed systems. Forces [force], displacements [length].
   *
   * It keeps vectors where it computes with them, which may be in the memory of
   * many processes. They are of use to the system that made them, no longer
   * than it lives. Between systems, numbers are those of a process's own
   * unknowns: those that it computes with, in ascending order, and behind them
   * all unknowns of contact, which each process has. They are all unknowns
   * where a system is a process's own.
   */
  class LargeSystem
  {
  public:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;
    using Kept  = std::shared_ptr<const LargeVector>;

    virtual ~LargeSystem() = default;

    virtual Index
    n_unknowns() const = 0;

    /** How many of them are a process's own. */
    virtual Index
    n_own() const
    {
      return n_unknowns();
    }
    /** Own ones of the numbers of all unknowns. */
    virtual Array
    own(Array all) const
    {
      return all;
    }
    /** All of them, from own ones; all processes call this. */
    virtual Array
    all(Array own) const
    {
      return own;
    }
    /** The largest magnitude of all, from own ones; all processes call this. */
    virtual double
    largest(const Array &own) const
    {
      return own.size() > 0 ? own.lpNorm<Eigen::Infinity>() : 0.;
    }

    /** From own numbers, and back. */
    virtual Kept
    keep(const Array &x) const = 0;
    virtual Array
    numbers(const Kept &x) const = 0;
    /** Those of the unknowns of contact. */
    virtual Array
    of_contact(const Kept &x) const = 0;
    /** x + factor y. */
    virtual Kept
    add(const Kept &x, const double factor, const Kept &y) const = 0;
    /** The scalar product of what is not of contact. */
    virtual double
    product_elsewhere(const Kept &x, const Kept &y) const = 0;

    /** K u. */
    virtual Kept
    multiply(const Kept &u) const = 0;

    /** Diagonal of K, of all unknowns. */
    virtual Array
    diagonal() const = 0;

    /** A change of u, and how many linear iterations it took. */
    struct Step
    {
      Kept         du;
      unsigned int iterations = 0;
      double       error = 0; ///< what is left of the right-hand side, relative
    };

    /**
     * How exactly a linear system is solved: what is left of its right-hand
     * side is at most `relative` times its norm, or times the norm of what
     * contacts carry, where that is known and less. Small motions that are
     * prescribed to hard bodies are large right-hand sides.
     */
    struct Precision
    {
      double relative = 0;
      double forces   = 0; ///< of contacts; 0: not known
    };

    /**
     * The change du that takes away the imbalance f = K u - b of all unknowns
     * but those of contact, and fulfils the laws
     * @f$P_i \delta u_i + D_i (K \delta u)_i = h_i@f$ of the nodes there, to
     * the precision asked for, or as far as possible. Nothing if the
     * result is not finite.
     */
    virtual std::optional<Step>
    solve(const std::vector<NodeLaw> &laws,
          const Kept                 &f,
          const Precision            &precision) const = 0;
  };
} // namespace conetact::solvers

#endif
