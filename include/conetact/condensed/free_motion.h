// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_free_motion_h
#define conetact_condensed_free_motion_h

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace conetact::condensed
{
  /** Numbers between -1 and 1, the same in every run and on every machine. */
  Eigen::VectorXd
  numbers_without_order(const Eigen::Index n);

  /**
   * Whether a factorised matrix A was singular but for rounding cannot be
   * read from its pivots: those of a singular matrix may be positive and no
   * smaller than those of a slender beam. What a beam does not have is a
   * displacement whose strain energy is lost in rounding. One step of inverse
   * iteration finds it where it exists: solve A v = probe_load(diagonal of A)
   * and hand v to refuse_free_motion.
   */
  Eigen::VectorXd
  probe_load(const Eigen::VectorXd &diagonal);

  /**
   * Throws SingularMatrix if @f$ v^T A v @f$ is rounding. A is the block of
   * the first v.size() unknowns of the matrix whose upper triangle is `upper`,
   * `node_of` the node of each unknown. The measure is that of the single
   * terms, so that neither units nor contrasts of stiffness matter.
   */
  void
  refuse_free_motion(const Eigen::SparseMatrix<double> &upper,
                     const Eigen::VectorXd             &v,
                     const std::vector<unsigned int>   &node_of);
} // namespace conetact::condensed

#endif
