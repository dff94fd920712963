// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_null_and_range_h
#define conetact_contact_null_and_range_h

#include <Eigen/Core>

namespace conetact::contact
{
  /** Parts of a symmetric positive semidefinite matrix. */
  struct NullAndRange
  {
    Eigen::MatrixXd null, range; ///< orthonormal columns
    Eigen::MatrixXd pseudo_inverse;
  };

  /** Splits a sum of squares of directions, whose entries are about one. */
  NullAndRange
  split(const Eigen::MatrixXd &gram);
} // namespace conetact::contact

#endif
