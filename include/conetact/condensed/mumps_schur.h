// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_mumps_schur_h
#define conetact_condensed_mumps_schur_h

#include "conetact/condensed/schur_solver.h"

#include <memory>

namespace conetact::condensed
{
  /**
   * MUMPS factorises A once, with the unknowns C ordered last, and returns the
   * Schur complement itself. It is given its triplets directly, which is the
   * fastest way.
   */
  class MumpsSchur : public SchurSolver
  {
  public:
    /** As SchurSolver says. Throws SingularMatrix, std::bad_alloc. */
    MumpsSchur(const Eigen::SparseMatrix<double> &upper,
               const Eigen::Index                 n_schur,
               const std::vector<unsigned int>   &node_of);
    ~MumpsSchur() override;
    /** What that would take: orders and analyses, but does not factorise. */
    static FactorEstimate
    estimate(const Eigen::SparseMatrix<double> &upper,
             const Eigen::Index                 n_schur,
             const std::vector<unsigned int>   &node_of);

    Eigen::MatrixXd
    take_schur_complement() override;
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const override;
    Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b, const Eigen::MatrixXd &u_C) const override;
    double
    factor_bytes() const override;
    const SchurWork &
    work() const override;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace conetact::condensed

#endif
