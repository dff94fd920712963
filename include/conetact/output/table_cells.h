// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_table_cells_h
#define conetact_output_table_cells_h

#include <optional>
#include <string_view>
#include <vector>

namespace conetact::output
{
  /** The cells of a line of a table; they are parts of its text. */
  std::vector<std::string_view>
  cells_of(const std::string_view line);

  /** As this program writes numbers, not as C reads them: no 0x10, no blanks.
   * Nothing: the text is none, or not finite. */
  std::optional<double>
  finite_number(const std::string_view text);
} // namespace conetact::output

#endif
