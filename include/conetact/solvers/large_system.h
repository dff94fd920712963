// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_large_system_h
#define conetact_solvers_large_system_h

#include "conetact/solvers/node_law.h"

#include <optional>
#include <vector>

namespace conetact::solvers
{
  /**
   * An elastic system @f$K u = b + H^T r@f$ in all its unknowns, too large to
   * be condensed: the unknowns of contact are the last ones of u, as a
   * ContactSystem numbers them, K is symmetric and positive semidefinite. It
   * does the linear algebra of a Newton step as NewtonSystem does that of
   * condensed systems. Forces [force], displacements [length].
   */
  class LargeSystem
  {
  public:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;

    virtual ~LargeSystem() = default;

    virtual Index
    n_unknowns() const = 0;

    /** K u. */
    virtual Array
    multiply(const Array &u) const = 0;

    /** Diagonal of K. */
    virtual Array
    diagonal() const = 0;

    /** A change of u, and how many linear iterations it took. */
    struct Step
    {
      Array        du;
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
          const Array                &f,
          const Precision            &precision) const = 0;
  };
} // namespace conetact::solvers

#endif
