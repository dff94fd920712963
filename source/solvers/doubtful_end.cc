// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/doubtful_end.h"

namespace conetact::solvers
{
  bool
  lets_go(const Eigen::VectorXd &start,
          const Eigen::VectorXd &end,
          const double           part)
  {
    eigen_assert(start.size() == end.size());
    return !start.isZero(0) && largest(end) <= part * largest(start);
  }



  bool
  is_held_by_rounding(const ContactProblem &problem, const ContactState &end)
  {
    constexpr double     far    = 1e6;
    const ContactSystem &system = *problem.system;
    const Eigen::Index   n      = system.n_contact_unknowns();
    if (system.large || system.null_space.cols() == 0 || n == 0)
      return false;
    const double mean  = system.matrix.diagonal().head(n).mean();
    const double force = largest(end.r.head(n));
    const bool   stiff = system.form == Form::stiffness;
    const double length =
      stiff ? force / mean + largest(problem.offset) + largest(problem.gap) :
              force * mean + largest(problem.load.head(n));
    return largest(end.v.head(n)) > far * length;
  }
} // namespace conetact::solvers
