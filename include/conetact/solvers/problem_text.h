// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_problem_text_h
#define conetact_solvers_problem_text_h

#include "conetact/solvers/contact_problem.h"

#include <iosfwd>
#include <string>

namespace conetact::solvers
{
  /**
   * A contact problem that stands alone: an increment, or a stage of a load
   * path with @f$f = f_0 + (p - p_0) f'@f$ while p goes from @f$p_0@f$ to
   * @f$p_1@f$, whose displacements are total ones.
   */
  struct StoredProblem
  {
    ContactProblem  problem;            ///< its load is f_0
    Eigen::VectorXd rate;               ///< f'; empty: an increment
    double          begin = 0, end = 1; ///< p_0, p_1
    Eigen::VectorXd cohesion;           ///< of each node [force]; empty: none

    bool
    is_stage() const
    {
      return rate.size() > 0;
    }
  };

  /**
   * The problem as plain text that any program can read and that loses no
   * digit. After a line that names the form come blocks, each a line
   * `name rows columns` and the numbers of so many rows; `#` starts a comment:
   * - `tangents`, `friction`: number of tangential unknowns and mu of each node
   * - `motions`: number of rigid motions behind them (compliance form)
   * - `matrix`, `null_space`, `load`, `gap`, `offset`: as in ContactSystem and
   *   ContactProblem
   * - `reference_force`
   * - `rate`, `stage` (p_0 and p_1), `cohesion`: of a load path
   *
   * Blocks that are empty or zero are left out. Units are those of the scene.
   */
  std::string
  to_problem_text(const StoredProblem &stored);

  /** Throws std::invalid_argument, a sentence, where the text is no problem. */
  StoredProblem
  read_problem_text(std::istream &text);
} // namespace conetact::solvers

#endif
