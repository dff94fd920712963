// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/nearest.h"

#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  std::size_t
  n_changes(const std::string &a, const std::string &b)
  {
    std::vector<std::size_t> last(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
      last[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        std::vector<std::size_t> next = {i + 1};
        for (std::size_t j = 0; j < b.size(); ++j)
          next.push_back(std::min(
            {next[j] + 1, last[j + 1] + 1, last[j] + (a[i] == b[j] ? 0 : 1)}));
        last = std::move(next);
      }
    return last.back();
  }



  std::string
  nearest(const std::string &name, const std::vector<std::string> &names)
  {
    const std::string own = lower_case(name);
    std::string       best;
    std::size_t       least = name.size() / 2 + 1;
    for (const std::string &candidate : names)
      {
        const std::string other  = lower_case(candidate);
        const bool        begins = other.rfind(own, 0) == 0;
        const bool        ends =
          other.size() > own.size() + 1 &&
          other.substr(other.size() - own.size() - 1) == ' ' + own;
        const std::size_t changes = own == other   ? 0 :
                                    begins || ends ? 1 :
                                                     n_changes(own, other);
        if (changes < least)
          {
            best  = candidate;
            least = changes;
          }
      }
    return best;
  }



  std::string
  did_you_mean(const std::string &name, const std::vector<std::string> &names)
  {
    const std::string other = name.empty() ? "" : nearest(name, names);
    return other.empty() ? "" : " Did you mean '" + other + "'?";
  }
} // namespace conetact
