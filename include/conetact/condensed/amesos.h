// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_amesos_h
#define conetact_condensed_amesos_h

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <memory>
#include <string>

namespace conetact::condensed
{
  /**
   * One matrix, factorised by a direct solver of Trilinos' Amesos on this
   * process alone, with blocks of right-hand sides. deal.II's
   * TrilinosWrappers::SparseMatrix holds the matrix; Amesos is called itself,
   * since deal.II's SolverDirect takes one right-hand side at a time.
   */
  class Amesos
  {
  public:
    /**
     * `name`: Amesos_Klu, Amesos_Mumps or Amesos_Lapack. `matrix`: both
     * triangles, with at least one row. Throws std::runtime_error for a solver
     * that this Trilinos was built without.
     */
    Amesos(const std::string                                  &name,
           const Eigen::SparseMatrix<double, Eigen::RowMajor> &matrix);
    ~Amesos();
    Amesos(const Amesos &) = delete;
    Amesos &
    operator=(const Amesos &) = delete;

    /**
     * False where there is no factor, since the matrix is singular or memory
     * does not suffice: Amesos does not say which.
     */
    bool
    is_factorised() const;

    /** Columns b -> x. */
    Eigen::MatrixXd
    solve(Eigen::MatrixXd b) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace conetact::condensed

#endif
