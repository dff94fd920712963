// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/true_gap.h"

#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    /** Tells whether an obstacle turns by more than rounding. */
    bool
    is_turned(const RigidMotion &motion)
    {
      return (motion.rotation - RigidMotion().rotation).norm() > 1e-6;
    }
  } // namespace

  double
  true_gap(const MovedNode &moved)
  {
    Assert(moved.node != nullptr && moved.node->obstacle != nullptr,
           dealii::ExcMessage("Only obstacles have shapes."));
    const ContactNode &node = *moved.node;
    const double       drawn =
      node.obstacle->shape->gap_after(node.position,
                                      moved.motion.relative(node.position,
                                                            moved.u),
                                      node.spacing);
    // A mean over faces is off by what its gap differs from that of its own
    // node at the start.
    return drawn + gap_beside_own(node) +
           (node.growth ? node.growth(0) : 0); // as adjusted
  }

  std::optional<GapError>
  worst_gap_error(const std::vector<MovedNode> &nodes, const double indentation)
  {
    Assert(indentation >= 0, dealii::ExcMessage("An indentation is a depth."));
    constexpr double part = .01; // of a cell or of the indentation

    std::optional<GapError> worst;
    double                  largest = 1;
    for (const MovedNode &moved : nodes)
      {
        const double allowed =
          part * std::max(moved.node->spacing, indentation);
        // Small kinematics has the gap that is linear in the displacement, at
        // the undeformed node: what it is off by is judged where bodies touch.
        const double actual = true_gap(moved);
        // A node that is apart by both gaps has no force that could be wrong.
        if (std::min(actual, moved.gap) > allowed)
          continue; // open by both
        if (const double error = std::abs(actual - moved.gap) / allowed;
            error > largest)
          {
            worst = GapError{
              moved.node, moved.gap, actual, allowed, is_turned(moved.motion)};
            largest = error;
          }
      }
    return worst;
  }

  std::string
  to_sentence(const GapError &error)
  {
    return "the obstacle '" + error.node->obstacle->name +
           (error.turned ? "' turns" : "' is curved") +
           ", and it and the body have moved so far past each "
           "other that the gap of the node at " +
           to_text(error.node->position) + " is " + to_text(error.actual) +
           " by the obstacle's shape, but " + to_text(error.linearised) +
           " by the contact, which is linearised at the undeformed node; " +
           to_text(error.allowed) +
           " is allowed, a hundredth of a cell or of the indentation";
  }
} // namespace conetact::pairing
