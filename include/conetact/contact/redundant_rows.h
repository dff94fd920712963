// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_redundant_rows_h
#define conetact_contact_redundant_rows_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/rigid_motions.h"

#include <Eigen/SparseCore>

#include <vector>

namespace conetact::contact
{
  /**
   * Bound directions (of ties and bilateral contacts) that others imply, or
   * supports: nodes that are held twice. The rank is that of the rows
   * themselves, which are about one and of which dependent ones differ by
   * rounding; in flexibilities both would be squared, and depend on stiffness.
   */
  struct RedundantRows
  {
    /** Rows that imply all others, sorted. */
    std::vector<Eigen::Index> independent;
    /**
     * Reactions that act on nothing but supports and each other, orthonormal
     * columns: how those who hold the same share its force is open.
     */
    Eigen::SparseMatrix<double> open;

    /** The least of the reactions that do the same. */
    Eigen::VectorXd
    least(const Eigen::VectorXd &reactions) const
    {
      return open.cols() == 0 ?
               reactions :
               Eigen::VectorXd(reactions -
                               open * (open.transpose() * reactions).eval());
    }
  };

  /**
   * Redundant ones of rows over any unknowns. Those from first[i] to first[i+1]
   * belong to one node, and most nodes have unknowns of their own.
   */
  RedundantRows
  find_redundant_rows(const Eigen::SparseMatrix<double, Eigen::RowMajor> &rows,
                      const std::vector<Eigen::Index> &first);

  /** Redundant rows of all that is bound, over what supports leave free. */
  RedundantRows
  find_redundant_rows(const model::Bodies &bodies,
                      const ContactPoints &points,
                      const Coordinates   &coordinates,
                      const RigidMotions  &motions);
} // namespace conetact::contact

#endif
