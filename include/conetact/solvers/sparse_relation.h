// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_sparse_relation_h
#define conetact_solvers_sparse_relation_h

#include "conetact/solvers/linear_relation.h"

#include <Eigen/Sparse>

namespace conetact::solvers
{
  /**
   * The scaled relation @f$d = M p + l@f$ of LinearRelation with M as a sparse
   * matrix, for problems whose contacts know only their neighbours: of many
   * bodies the compliance couples contacts on the same body only. M need not
   * be symmetric.
   */
  struct SparseRelation
  {
    using Matrix = Eigen::SparseMatrix<double>;

    SparseRelation(const LinearRelation &linear_relation);

    /** d = M p + l. */
    Eigen::VectorXd
    dual(const Eigen::VectorXd &p) const
    {
      return M * p + relation.load();
    }

    const LinearRelation &relation; ///< must outlive this object
    Matrix                M;
  };
} // namespace conetact::solvers

#endif
