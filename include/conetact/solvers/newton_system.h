// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_newton_system_h
#define conetact_solvers_newton_system_h

#include "conetact/solvers/linear_relation.h"
#include "conetact/solvers/node_law.h"
#include "conetact/solvers/reused_factor.h"

#include <vector>

namespace conetact::solvers
{
  /**
   * The linear algebra of one Newton step of any contact solver. A solver says
   * what its linearised law is, node by node,
   * @f[ P_i \delta p_i + D_i \delta d_i = h_i, @f]
   * and the relation @f$\delta d = M \delta p + \rho@f$ does the rest:
   * @f$(P + D M) \delta p = h - D \rho@f$. Rows with D = 0 that say what one
   * unknown is (closed gaps, stuck slips, open reactions) are eliminated, so
   * only the small rest is factorised. Without units (see LinearRelation).
   */
  class NewtonSystem
  {
  public:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;

    /**
     * Solves for the increment of p, to the relative precision asked for (a
     * hint: small systems are always solved directly, and all of them where it
     * is 0). False if the matrix is singular, beyond help where `regularised`,
     * or the result is not finite.
     */
    bool
    solve(const LinearRelation       &relation,
          const std::vector<NodeLaw> &laws,
          const Array                &rho,
          const double                precision,
          Array                      &dp,
          const bool                  regularised = true);

    /**
     * Solves once more with the factors of the last system, for laws at another
     * point. False if there are none, or other unknowns are left.
     */
    bool
    solve_again(const LinearRelation       &relation,
                const std::vector<NodeLaw> &laws,
                Array                      &dp);

    /** Whether it may do so. */
    bool
    has_factors() const
    {
      return is_factorized;
    }

    /** Whether the last system was too small to save a factorisation. */
    bool
    was_small() const;

    unsigned int
    n_factorizations() const
    {
      return factorizations;
    }

  private:
    /** Which unknowns are left, and their rows of the law. */
    void
    split(const LinearRelation &relation, const std::vector<NodeLaw> &laws);

    /** Sets the known part of dp and the right-hand side of the rest. */
    void
    eliminate(const LinearRelation       &relation,
              const std::vector<NodeLaw> &laws,
              const Array                &rho,
              Array                      &dp);

    template <typename Matrix>
    void
    add_node_blocks(const std::vector<NodeLaw> &laws,
                    const double                shift,
                    Matrix                     &J) const;
    template <typename Matrix>
    void
    assemble(const LinearRelation       &relation,
             const std::vector<NodeLaw> &laws,
             const double                shift,
             Matrix                     &J) const;

    bool
    solve_with_reuse(const LinearRelation       &relation,
                     const std::vector<NodeLaw> &laws,
                     const double                precision,
                     Array                      &x);
    bool
    solve_directly(const LinearRelation       &relation,
                   const std::vector<NodeLaw> &laws,
                   const double                shift,
                   Array                      &x);
    /** With the factors in `matrix`. */
    void
    substitute(Array &x) const;
    /** Writes what was left of the unknowns to dp. */
    void
    scatter(const Array &x, Array &dp) const;

    struct Row
    {
      Index node, local;
    };
    std::vector<Index> unknown; ///< global indices of what is left
    std::vector<Row>   row;     ///< the same, by node
    Array              right_hand_side;
    Eigen::MatrixXd    matrix; ///< and its factors
    std::vector<int>   pivots; ///< of them
    bool               is_factorized = false;
    Eigen::MatrixXf    single;
    std::vector<Index> assembled;     ///< unknowns of `single`
    bool               fresh = false; ///< it was assembled in the last solve
    double             last_norm = 0; ///< of the right-hand side there
    ReusedFactor       reused;
    unsigned int       factorizations = 0;
  };
} // namespace conetact::solvers

#endif
