// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_unseen_motions_h
#define conetact_contact_unseen_motions_h

#include <Eigen/Core>

namespace conetact::contact
{
  /**
   * Combinations of motions (columns, of entries about one) that rows see only
   * by rounding, such as the spin of a ring in a frictionless bore:
   * orthonormal. The rows do not see them any more, exactly: solvers shall find
   * zeros there, not rounding to divide by.
   */
  Eigen::MatrixXd
  forget_unseen(Eigen::MatrixXd &rows);
} // namespace conetact::contact

#endif
