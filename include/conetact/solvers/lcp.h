// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_lcp_h
#define conetact_solvers_lcp_h

#include <Eigen/Dense>

namespace conetact::solvers
{
  /**
   * Solves the linear complementarity problem
   * @f$ x = M z + q,\ x \ge 0,\ z \ge 0,\ x \cdot z = 0 @f$ by Lemke's method
   * with the covering vector `cover` > 0 (Cottle, Pang, Stone: The Linear
   * Complementarity Problem, 1992, 4.4). Ties of the ratio test go to the
   * artificial variable, then to the x of the smallest `rank`, then to the
   * largest pivot. False if it ends on a ray: no solution was found.
   */
  bool
  solve_lcp(const Eigen::MatrixXd &M,
            const Eigen::VectorXd &q,
            const Eigen::VectorXd &cover,
            const Eigen::VectorXi &rank,
            Eigen::VectorXd       &z);
} // namespace conetact::solvers

#endif
