// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_unloaded_h
#define conetact_solvers_unloaded_h

#include "conetact/solvers/contact_problem.h"

#include <optional>

namespace conetact::solvers
{
  /**
   * The shortest a with @f$ G a + q \ge 0 @f$: a = G^T z with
   * @f$ G G^T z + q \ge 0,\ z \ge 0 @f$ complementary. `rows` is G, `gap` q.
   * None where there is none.
   */
  std::optional<Eigen::VectorXd>
  shortest_way_out(const Eigen::MatrixXd &rows, const Eigen::VectorXd &gap);

  /**
   * The end of an increment in which no force presses any body and none is in
   * the way: no reaction, and bodies stay where supports carry them. None
   * where there is an interference, or held bodies are pressed at the `start`:
   * friction may have jammed them.
   */
  std::optional<ContactState>
  stay_without_load(const ContactProblem &problem, const ContactState &start);

  /**
   * The same where bodies that nothing presses are in the way: the shortest
   * motion that leaves no interference. None where foundations act or bodies
   * have no way out.
   */
  std::optional<ContactState>
  move_without_load(const ContactProblem &problem, const ContactState &start);
} // namespace conetact::solvers

#endif
