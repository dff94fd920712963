// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_extended_schur_h
#define conetact_backends_extended_schur_h

#include "conetact/backends/condenser.h"

namespace conetact::backends
{
  /**
   * A Schur complement to which eliminated unknowns N can be added with the
   * factor at hand. With @f$D = (A_{FF}^{-1})_{NN}@f$ and
   * @f$X = -(A_{FF}^{-1})_{NF} A_{FC}@f$ the unknowns added obey
   * @f$u_N = X u_C + D f_N + z_N@f$, z the displacements of the load, so that
   * @f[ S = \begin{pmatrix} S_C + X^T D^{-1} X & -X^T D^{-1}\\
   *         -D^{-1} X & D^{-1} \end{pmatrix} . @f]
   * Additions compose: @f$D = L L^T@f$ and @f$L^{-1} X@f$ only grow.
   */
  class ExtendedSchur
  {
  public:
    /** As SchurSolver, of that condenser. */
    ExtendedSchur(const Eigen::SparseMatrix<double> &upper,
                  const Eigen::Index                 n_schur,
                  const std::vector<unsigned int>   &node_of,
                  const Condenser &condenser = default_condenser());

    /**
     * Adds `unknowns`, eliminated so far, behind those of S, which becomes the
     * Schur complement of all. Throws SingularMatrix.
     */
    void
    extend(const std::vector<Eigen::Index> &unknowns, Eigen::MatrixXd &S);

    /** As SchurSolver::reduce, with the unknowns added last. */
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const;

    /**
     * As SchurSolver::expand; `u` and `reduced` have rows for the unknowns of
     * S, the result has those of A. `reduced` is reduce(b), not read as long
     * as nothing was added.
     */
    Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b,
           const Eigen::MatrixXd &u,
           const Eigen::MatrixXd &reduced) const;

    bool
    is_extended() const
    {
      return !added.empty();
    }

    /** Without what was added. */
    SchurSolver &
    base()
    {
      return *solver;
    }
    const SchurSolver &
    base() const
    {
      return *solver;
    }

  private:
    /** New columns of D (all its rows) and rows of X. */
    void
    append(const Eigen::MatrixXd &D, const Eigen::MatrixXd &X);

    Eigen::Index                 n_unknowns;
    std::unique_ptr<SchurSolver> solver;
    std::vector<Eigen::Index>    added;
    Eigen::MatrixXd              L, B; ///< D = L L^T, B = L^-1 X
  };
} // namespace conetact::backends

#endif
