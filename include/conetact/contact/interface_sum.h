// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_interface_sum_h
#define conetact_contact_interface_sum_h

#include "conetact/contact/substructure_solver.h"

namespace conetact
{
  /**
   * The sum of all @f$T^T S T@f$, S dense: a sparse matrix of dense blocks.
   * Unknowns that the same uses see are a class; they have the same pattern.
   */
  class InterfaceSum
  {
  public:
    /** T of each use, with the same number of columns. */
    explicit InterfaceSum(const std::vector<Substructure::Map> &maps);

    /** The upper triangle, filled with zeros. */
    Eigen::SparseMatrix<double>
    pattern() const;
    /** Adds a use to it. */
    void
    add(const std::size_t            use,
        const Substructure::Map     &T,
        const Eigen::MatrixXd       &S,
        Eigen::SparseMatrix<double> &upper) const;

    /** Of each unknown the first of its class. */
    const std::vector<Eigen::Index> &
    first_of_class() const
    {
      return first;
    }

    /**
     * What a SchurSolver will take, if it eliminates class by class the one
     * with the fewest neighbors first. The matrix is not formed.
     */
    FactorEstimate
    estimate(const Eigen::Index n_schur) const;

  private:
    std::vector<std::vector<Eigen::Index>> columns; ///< that each use sees
    std::vector<Eigen::Index>              first;
  };
} // namespace conetact

#endif
