// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_stage_layout_h
#define conetact_analysis_stage_layout_h

#include "conetact/base/archive.h"
#include "conetact/contact/contact_model.h"

#include <vector>

namespace conetact::analysis
{
  /** Which contact nodes there are, and how many unknowns each has. */
  void
  put_layout(const contact::ContactPoints &points, Archive &archive);

  /**
   * Takes what is kept of contact nodes from the layout of one stage to that
   * of the next one, whose supports hold others: reactions along directions
   * that both have stay, those along what a support has taken over are its own
   * now, and what it has released begins without any, where it is. What laws
   * remember of nodes that a support holds stays in the archive until it lets
   * them go. False: both are alike.
   */
  bool
  take_to_layout(const contact::ContactModel &model, Archive &archive);

  /** What an archive remembers of nodes that supports hold in this stage, for
   * the next archive. */
  std::vector<double>
  held_nodes(const Archive &archive);
  /** Depths that nodes had worn when supports took them, 0 of others. */
  std::vector<double>
  worn_while_held(const std::vector<double>               &held,
                  const std::vector<pairing::ContactNode> &nodes);
  void
  put_held_nodes(const std::vector<double> &held, Archive &archive);
} // namespace conetact::analysis

#endif
