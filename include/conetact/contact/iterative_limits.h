// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_iterative_limits_h
#define conetact_contact_iterative_limits_h

#include "conetact/contact/contact_points.h"

#include <string>

namespace conetact::contact
{
  /** Why IterativeElasticity cannot solve a scene, as the end of a sentence;
   * empty: it can. */
  std::string
  why_not_iterative(const model::Bodies &bodies,
                    const NodeRules     &supports,
                    const ContactPoints &points);
} // namespace conetact::contact

#endif
