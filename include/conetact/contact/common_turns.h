// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_common_turns_h
#define conetact_contact_common_turns_h

#include "conetact/model/bodies.h"

namespace conetact::contact
{
  /**
   * Lets bodies turn together where supports and obstacles do. On facets of
   * curved sides a contact node and what it meets stand apart: a turn of both
   * bodies would slip there, and forces of both sides would turn them, which
   * nothing but friction could balance. There the opponent is not the mean over
   * nodes of faces, but over those of the cells behind them as well, such that
   * it stands where the contact node does (as a field that is linear in the
   * cells is continued to that place). Contacts that slide far or tie keep
   * theirs.
   */
  void
  keep_common_turns_free(model::Bodies &bodies);
} // namespace conetact::contact

#endif
