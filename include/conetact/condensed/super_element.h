// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_super_element_h
#define conetact_condensed_super_element_h

#include "conetact/condensed/condenser.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace conetact::condensed
{
  /**
   * A body by itself, condensed to the unknowns it keeps (those of nodes that
   * may touch), as an elastic answer to forces: its deformation is
   * @f$ w = K^+ f @f$, free of rigid motions as the retained unknowns see them,
   * @f$ B^T w_C = 0 @f$. With the Schur complement S of its stiffness on the
   * retained unknowns and B an orthonormal basis of its free motions there,
   * @f[ T = (S + \alpha B B^T)^{-1},\quad
   *     P = T - T B (B^T T B)^{-1} B^T T ,\quad w_C = P f_C . @f]
   * Forces that do not balance are answered as if motions were held by forces
   * along B; whoever asks has balance as an equation of its own. P is explicit,
   * so that the flexibility of any contact rows H costs a product, H P H^T.
   * Where displacements of the retained unknowns are asked for instead, S is
   * all that is needed, and no motion has to be known. Stiffness may contain
   * foundations. Serves all bodies equal to this one.
   */
  class SuperElement
  {
  public:
    using Index = Eigen::Index;

    /**
     * `upper`: upper triangle of the stiffness, `node_of` its nodes as in
     * SchurSolver; `retained` ascend; `motions`: columns of free motions in all
     * unknowns, whose rows at retained unknowns must be independent. Throws
     * SingularMatrix if a part of the body can move although the retained
     * unknowns are fixed.
     */
    SuperElement(const Eigen::SparseMatrix<double> &upper,
                 const std::vector<unsigned int>   &node_of,
                 const std::vector<Index>          &retained,
                 const Eigen::MatrixXd             &motions,
                 const Condenser &condenser = default_condenser());

    /** What its factorisation would take; nothing is factorised. */
    static FactorEstimate
    estimate(const Eigen::SparseMatrix<double> &upper,
             const std::vector<unsigned int>   &node_of,
             const std::vector<Index>          &retained,
             const Condenser &condenser = default_condenser());

    /** Without P, which takes no motions: S by take_stiffness(), and carry().
     */
    SuperElement(const Eigen::SparseMatrix<double> &upper,
                 const std::vector<unsigned int>   &node_of,
                 const std::vector<Index>          &retained,
                 const Condenser                   &condenser);

    const std::vector<Index> &
    retained() const
    {
      return kept;
    }
    /** S, handed over once [force/length]. */
    Eigen::MatrixXd
    take_stiffness();
    /** P, its inverse stiffness on the retained unknowns [length/force]. */
    const Eigen::MatrixXd &
    flexibility() const
    {
      return P;
    }
    /** Forces on all unknowns (columns), as the retained ones see them. */
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &forces) const;
    /** Deformation of all unknowns under forces on all unknowns (columns). */
    Eigen::MatrixXd
    deform(const Eigen::MatrixXd &forces) const;

    /** The same where the retained ones are displaced by `w` (columns). */
    Eigen::MatrixXd
    carry(const Eigen::MatrixXd &forces, const Eigen::MatrixXd &w) const;

    const SchurSolver &
    solver() const
    {
      return *factor;
    }

  private:
    Eigen::MatrixXd
    to_solver(const Eigen::MatrixXd &x) const;

    std::vector<Index>                       kept;
    Eigen::PermutationMatrix<Eigen::Dynamic> place; ///< retained ones last
    double                                   scale; ///< of stiffness
    std::unique_ptr<SchurSolver>             factor;
    Eigen::MatrixXd                          S; ///< over the scale
    Eigen::MatrixXd                          P;
  };
} // namespace conetact::condensed

#endif
