// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_adjusted_gaps_h
#define conetact_pairing_adjusted_gaps_h

#include "conetact/pairing/contact_nodes.h"

namespace conetact::pairing
{
  /** Estimates of facets may be that much too small. */
  constexpr double facet_margin = 1.5;

  /**
   * Takes nodes of a contact apart by what means over convex faces of second
   * degree are below all gaps there: functions at corners are dual to linear
   * ones, and see a gap x^2/(2 R) from a node on as -h^2/(12 R), h the size of
   * a face. Without it a round body that is drawn to touch starts inside. Of
   * all nodes of faces that are bent alike it is the same, so pressures do not
   * change: the body comes nearer by so much. Nodes of plane faces stay. It
   * stays wherever nodes slide (ContactNode::growth). Returns whether there is
   * any.
   */
  bool
  lift_convex_faces(const Contact                                &contact,
                    const unsigned int                            number,
                    const std::vector<const bodies::Structure *> &structures,
                    std::vector<ContactNode>                     &nodes);

  /**
   * Takes nodes of a contact as touching where they are drawn to touch: their
   * gap, positive or negative, is within what the facets of both sides stand
   * off the curved surfaces. What is taken off a gap stays taken off wherever
   * the node slides (ContactNode::growth); other nodes keep their gaps.
   */
  void
  adjust_gaps(const Contact                                &contact,
              const unsigned int                            number,
              const std::vector<const bodies::Structure *> &structures,
              std::vector<ContactNode>                     &nodes);

  /** The gap of a node at t = 0, as drawn, adjusted or written down. */
  double
  gap_at_start(const ContactNode &node);
} // namespace conetact::pairing

#endif
