// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_nearest_h
#define conetact_base_nearest_h

#include <string>
#include <vector>

namespace conetact
{
  /** Levenshtein's distance: how many letters must be changed. */
  std::size_t
  n_changes(const std::string &a, const std::string &b);

  /**
   * The name that is most like one that does not exist, whatever its capitals:
   * a few letters off, or with that beginning or that last word. Empty: none.
   */
  std::string
  nearest(const std::string &name, const std::vector<std::string> &names);

  /** " Did you mean 'sole'?", behind another sentence; empty: that is not
   * known. */
  std::string
  did_you_mean(const std::string &name, const std::vector<std::string> &names);
} // namespace conetact

#endif
