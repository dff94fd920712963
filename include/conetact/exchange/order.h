// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_exchange_order_h
#define conetact_exchange_order_h

#include "conetact/solvers/contact_problem.h"

#include <Eigen/Dense>

namespace conetact::exchange
{
  /**
   * From our order of the unknowns of a contact, (t1, [t2,] n), to that of
   * FCLib, (n, t1[, t2]), and back.
   */
  class FclibOrder
  {
  public:
    explicit FclibOrder(const solvers::ContactSystem &system)
      : indices(system.n_unknowns())
    {
      for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
        {
          Eigen::Index there = system.first[i];
          indices[there++]   = system.normal(i);
          for (Eigen::Index j = system.first[i]; j < system.normal(i); ++j)
            indices[there++] = j;
        }
    }

    Eigen::VectorXd
    to_file(const Eigen::VectorXd &x) const
    {
      return x(indices);
    }
    Eigen::MatrixXd
    to_file(const Eigen::MatrixXd &A) const
    {
      return A(indices, indices);
    }
    Eigen::VectorXd
    from_file(const Eigen::VectorXd &x) const
    {
      Eigen::VectorXd result(x.size());
      result(indices) = x;
      return result;
    }
    Eigen::MatrixXd
    from_file(const Eigen::MatrixXd &A) const
    {
      Eigen::MatrixXd result(A.rows(), A.cols());
      result(indices, indices) = A;
      return result;
    }

  private:
    Eigen::Matrix<Eigen::Index, Eigen::Dynamic, 1> indices; ///< ours
  };
} // namespace conetact::exchange

#endif
