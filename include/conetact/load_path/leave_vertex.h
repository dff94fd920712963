// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_leave_vertex_h
#define conetact_load_path_leave_vertex_h

#include <Eigen/Dense>

#include <vector>

namespace conetact::load_path
{
  /**
   * A ray of @f$ x = M z + q\,p' @f$ with @f$0 \le z \perp x \ge 0@f$: of each
   * pair one of the two may be positive, `value`, and the other is zero.
   */
  struct Ray
  {
    std::vector<bool> moves; ///< of each pair: z may be positive, else x
    Eigen::VectorXd   value; ///< of the one that may be positive
    double            p = 0; ///< rate of the parameter, of any sign

    Eigen::VectorXd
    z() const;
  };

  /**
   * The line of rays in which the pairs move as told: every multiple of the
   * result fulfils the linear equation, of one sign also the inequalities.
   */
  Ray
  line_of(const Eigen::MatrixXd   &M,
          const Eigen::VectorXd   &q,
          const std::vector<bool> &moves);

  /**
   * The rays meet in a vertex of a path. One comes in; along which one does the
   * path leave? By pivoting as in Lemke's method with p as its parameter
   * (Cottle, Pang, Stone: The Linear Complementarity Problem, 1992, 4.4 and
   * 4.5): with `weight` > 0 in place of all values that vanish in the vertex,
   * the path comes in along the same direction, turns at some vertices close
   * by, and leaves along a ray. p may grow on it, fall, or stand still.
   * `ray` is the forward direction of the piece that comes in, and then the ray
   * found. Pairs that vanish together turn together; false if they then
   * contradict each other, which weights without ties avoid.
   */
  bool
  leave_vertex(const Eigen::MatrixXd &M,
               const Eigen::VectorXd &q,
               const Eigen::VectorXd &weight,
               Ray                   &ray);
} // namespace conetact::load_path

#endif
