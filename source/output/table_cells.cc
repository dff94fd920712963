// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/table_cells.h"

#include <charconv>
#include <cmath>

namespace conetact::output
{
  std::vector<std::string_view>
  cells_of(const std::string_view line)
  {
    std::vector<std::string_view> cells;
    std::size_t                   begin = 0;
    for (std::size_t comma; (comma = line.find(',', begin)) != line.npos;
         begin = comma + 1)
      cells.push_back(line.substr(begin, comma - begin));
    cells.push_back(line.substr(begin));
    return cells;
  }



  std::optional<double>
  finite_number(const std::string_view text)
  {
    double            value  = 0;
    const char *const end    = text.data() + text.size();
    const auto [rest, fault] = std::from_chars(text.data(), end, value);
    if (fault != std::errc() || rest != end || !std::isfinite(value))
      return {};
    return value;
  }
} // namespace conetact::output
