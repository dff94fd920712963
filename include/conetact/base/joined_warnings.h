// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_joined_warnings_h
#define conetact_base_joined_warnings_h

#include "conetact/base/log.h"

#include <string>
#include <vector>

namespace conetact
{
  /**
   * Warns by each of the sentences. Four or more that say the same of others,
   * but for names in quotes and numbers, are one warning: the first sentence,
   * with the names of all; each of the others stands in log.txt.
   */
  void
  warn(const std::vector<std::string> &sentences, Log &log);
} // namespace conetact

#endif
