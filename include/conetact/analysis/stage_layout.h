// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_stage_layout_h
#define conetact_analysis_stage_layout_h

#include "conetact/base/archive.h"
#include "conetact/contact/contact_model.h"

namespace conetact::analysis
{
  /** Which contact nodes there are, and how many unknowns each has. */
  void
  put_layout(const contact::ContactPoints &points, Archive &archive);

  /**
   * Takes what is kept of contact nodes from the layout of one stage to that
   * of the next one, whose supports hold others: reactions along directions
   * that both have stay, those along what a support has taken over are its own
   * now, and what it has released begins without any, where it is. False:
   * both are alike.
   */
  bool
  take_to_layout(const contact::ContactModel &model, Archive &archive);
} // namespace conetact::analysis

#endif
