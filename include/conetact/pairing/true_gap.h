// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_true_gap_h
#define conetact_pairing_true_gap_h

#include "conetact/pairing/contact_nodes.h"

#include <optional>
#include <string>
#include <vector>

namespace conetact::pairing
{
  /**
   * A node that may touch an obstacle, at the end of an increment. Contact is
   * linearised at the undeformed node; where the obstacle is curved and moved,
   * or turns, the gap by its shape where the node is in the obstacle's own
   * frame tells whether that still holds.
   * A prescribed gap is a function of the undeformed node and its own truth.
   */
  struct MovedNode
  {
    const ContactNode *node;   ///< with its obstacle and spacing
    Tensor<1, 3>       u;      ///< displacement since the start [length]
    RigidMotion        motion; ///< of the obstacle
    double             gap;    ///< by the linearised contact [length]
  };

  /** Gap by the obstacle's shape where node and obstacle are now [length]. */
  double
  true_gap(const MovedNode &moved);

  struct GapError
  {
    const ContactNode *node;
    double             linearised, actual, allowed; ///< [length]
    bool               turned;                      ///< the obstacle
  };
  /**
   * The node whose gap is off most, measured by what is allowed: a hundredth
   * of its spacing or of the indentation (how far the obstacle has deformed
   * the body [length]), whichever is larger. Only nodes that touch by either
   * gap, up to that bound, count. None: all gaps hold.
   */
  std::optional<GapError>
  worst_gap_error(const std::vector<MovedNode> &nodes,
                  const double                  indentation = 0);

  /** What is wrong and what to do, for the user. */
  std::string
  to_sentence(const GapError &error);
} // namespace conetact::pairing

#endif
