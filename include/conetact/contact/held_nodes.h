// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_held_nodes_h
#define conetact_contact_held_nodes_h

#include "conetact/contact/node_rules.h"

#include <map>
#include <string>

namespace conetact::contact
{
  /**
   * A contact node that a support holds along its normal has no reaction of
   * its own: the support has it. Where contact nodes are means over faces
   * (ContactNode::is_mean) the pressure around it must not be lost with it: the
   * nearest node of the contact takes its share of area, gap and masters, and
   * meets them with a mean over both.
   */
  void
  give_up_held_nodes(model::Bodies &bodies);

  /**
   * Why contacts that slide far cannot because supports hold their nodes, a
   * sentence without its full stop for each contact by number; others can.
   * Held nodes that meet nothing are no reason.
   */
  std::map<unsigned int, std::string>
  why_held_nodes_do_not_slide(const model::Bodies &bodies);
} // namespace conetact::contact

#endif
