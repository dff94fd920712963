// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_amesos_schur_h
#define conetact_condensed_amesos_schur_h

#include "conetact/condensed/amesos.h"
#include "conetact/condensed/schur_solver.h"

#include <memory>
#include <string>

namespace conetact::condensed
{
  /**
   * The Schur complement by the factor of A_FF alone: A_FF^-1 A_FC by blocks of
   * right-hand sides, S less its product with A_CF. Slower than MumpsSchur by
   * far, but it shares no step with it. Factors of Amesos do not tell how many
   * eigenvalues are negative: a stiffness has none but for rounding, and that
   * is seen by its energy (free_motion.h).
   */
  class AmesosSchur : public SchurSolver
  {
  public:
    /**
     * `solver`: a name that Amesos takes; the others as SchurSolver says.
     * Throws SingularMatrix, std::bad_alloc.
     */
    AmesosSchur(const std::string                 &solver,
                const Eigen::SparseMatrix<double> &matrix,
                const Eigen::Index                 n_schur,
                const std::vector<unsigned int>   &node_of);

    Eigen::MatrixXd
    take_schur_complement() override;
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const override;
    Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b, const Eigen::MatrixXd &u_C) const override;
    /** Amesos does not tell. */
    double
    factor_bytes() const override
    {
      return 0;
    }
    const SchurWork &
    work() const override
    {
      return done;
    }

  private:
    using Index        = Eigen::Index;
    using MatrixXd     = Eigen::MatrixXd;
    using VectorXd     = Eigen::VectorXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using Nodes        = std::vector<unsigned int>;

    void
    factorise(const std::string  &solver,
              const SparseMatrix &upper,
              const Nodes        &node_of);
    /** Throws why there is no factor. */
    [[noreturn]] void
    explain_failure(const std::string  &solver,
                    const SparseMatrix &upper,
                    const Nodes        &node_of) const;
    /** Scaled by `scale` on both sides, its diagonal times 1 + `shift`. */
    Eigen::SparseMatrix<double, Eigen::RowMajor>
    eliminated_block(const SparseMatrix &upper, const double shift) const;
    VectorXd
    probe(const Amesos &factor, const SparseMatrix &upper) const;
    /** A_FF^-1 b. */
    MatrixXd
    solve(const MatrixXd &b) const;
    void
    condense();

    const Index             n_schur, n_eliminated;
    VectorXd                scale; ///< of A_FF
    SparseMatrix            A_FC;
    std::unique_ptr<Amesos> factor; ///< of A_FF; none if it is empty
    MatrixXd                S;
    mutable SchurWork       done;
  };
} // namespace conetact::condensed

#endif
