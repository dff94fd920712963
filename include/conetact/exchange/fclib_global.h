// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_exchange_fclib_global_h
#define conetact_exchange_fclib_global_h

#include "conetact/exchange/hdf5_file.h"

#include <Eigen/SparseLU>

namespace conetact::exchange
{
  /**
   * A global problem of FCLib: velocities v of bodies, contacts and bilateral
   * constraints G,
   * @f[ M v = H r + G \lambda + f,\quad G^T v + b = 0,\quad u = H^T v + w, @f]
   * reduced to the local one, @f$u = W r + q@f$, by one sparse factorisation
   * of the matrix of v and @f$\lambda@f$. M and W need not be symmetric. All
   * vectors in the order of the file.
   */
  class FclibGlobal
  {
  public:
    /** Reads and factorises; throws InputError, also where v is not unique. */
    explicit FclibGlobal(const Hdf5File &file);

    Eigen::MatrixXd
    compliance() const;
    /** q. */
    Eigen::VectorXd
    free_velocity() const;

    /** What the reactions r make of the bodies. */
    struct Bodies
    {
      Eigen::VectorXd v, lambda;
    };
    Bodies
    bodies(const Eigen::VectorXd &r) const;

  private:
    using Sparse = Eigen::SparseMatrix<double>;

    void
    read(const Hdf5File &file);
    void
    factorize(const Hdf5File &file);
    /** (v, lambda) of forces and of -b or zero. */
    Eigen::MatrixXd
    solve(const Eigen::MatrixXd &forces, const Eigen::VectorXd &b) const;

    Sparse                  M, H, G;
    Eigen::VectorXd         f, b, w;
    Eigen::SparseLU<Sparse> lu;
  };
} // namespace conetact::exchange

#endif
