// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/sparse_relation.h"

#include <vector>

namespace conetact::solvers
{
  SparseRelation::SparseRelation(const LinearRelation &linear_relation)
    : relation(linear_relation)
  {
    eigen_assert(!relation.system().large);
    using Eigen::Index;
    const Eigen::MatrixXd              &A = relation.system().matrix;
    const Eigen::VectorXd              &s = relation.column_scale();
    std::vector<Eigen::Triplet<double>> entries;
    for (Index j = 0; j < A.cols(); ++j)
      for (Index i = 0; i < A.rows(); ++i)
        if (A(i, j) != 0 || i == j)
          entries.emplace_back(static_cast<int>(i),
                               static_cast<int>(j),
                               s(i) * A(i, j) * s(j));
    M.resize(A.rows(), A.cols());
    M.setFromTriplets(entries.begin(), entries.end());
  }
} // namespace conetact::solvers
