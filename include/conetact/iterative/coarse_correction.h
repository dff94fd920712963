// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_coarse_correction_h
#define conetact_iterative_coarse_correction_h

#include "conetact/iterative/contact_change.h"
#include "conetact/iterative/node_blocks.h"

#include <vector>

namespace conetact::iterative
{
  /** What corrects an approximation where the smoother of the finest level,
   * whose nodes have `fine` unknowns, hardly does. */
  template <int fine>
  class CoarseCorrection
  {
  public:
    virtual ~CoarseCorrection() = default;
    /** It becomes one of these states, node by node of contact. Not `exactly`:
     * unless it is one of states that differ from them but little. */
    virtual void
    set_states(const std::vector<NodeState<fine>> &states,
               const bool                          exactly) = 0;
    /** x is about the solution of A x = r. */
    virtual void
    correct(const FloatVector &r, FloatVector &x) = 0;
  };
} // namespace conetact::iterative

#endif
