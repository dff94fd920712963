// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_unloaded_h
#define conetact_solvers_unloaded_h

#include "conetact/solvers/contact_problem.h"

#include <optional>

namespace conetact
{
  /**
   * The end of an increment in which no force presses any body: the shortest
   * motion that leaves no interference, a = G_n^T z with
   * @f$ G_n G_n^T z + q_n \ge 0,\ z \ge 0 @f$ complementary, and no reaction.
   * None where forces or foundations act, bodies have no way out, or are
   * pressed at the `start` of the increment: friction may have jammed them.
   * In stiffness form, where bodies are held: no reaction if supports carry
   * them along without strain and nothing comes closer than it may.
   */
  std::optional<ContactState>
  move_without_load(const ContactProblem &problem, const ContactState &start);
} // namespace conetact

#endif
