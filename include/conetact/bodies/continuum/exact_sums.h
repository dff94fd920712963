// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_exact_sums_h
#define conetact_bodies_continuum_exact_sums_h

#include <Eigen/Core>

namespace conetact::bodies
{
  /**
   * Rounds the stiffness k of an element without rotations, dof
   * `dim * node + component`, so that translations do not strain it, to the
   * last bit, and that sums of 2^dim such matrices round nothing. An assembled
   * stiffness then keeps @f$\sum_i K_{ij} = 0@f$: otherwise equal cells make
   * equal errors, which add up over the area of a mesh and put its forces out
   * of balance. Entries change by 2^(dim - 54) of the largest one, some more
   * on the diagonal; k stays symmetric.
   */
  void
  make_sums_exact(Eigen::MatrixXd &k, const int dim);

  /**
   * The same of a ring round the y axis, which only translations along it do
   * not strain.
   */
  void
  make_axial_sums_exact(Eigen::MatrixXd &k);
} // namespace conetact::bodies

#endif
