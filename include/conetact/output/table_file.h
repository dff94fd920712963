// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_table_file_h
#define conetact_output_table_file_h

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace conetact::output
{
  /** A table of results as it stands on disk: names of columns, then rows. */
  class TableFile
  {
  public:
    /** Throws InputError where the file is no table. */
    explicit TableFile(const std::filesystem::path &file);
    TableFile(const TableFile &) = delete;
    TableFile &
    operator=(const TableFile &) = delete;

    const std::vector<std::string_view> &
    columns() const
    {
      return names;
    }
    /** Nothing: there is no such column. */
    std::optional<std::size_t>
    column(const std::string_view name) const;
    std::size_t
    n_rows() const
    {
      return rows.size();
    }
    std::string_view
    cell(const std::size_t row, const std::size_t column) const
    {
      return rows[row][column];
    }

  private:
    std::string                                text; ///< all others are parts
    std::vector<std::string_view>              names;
    std::vector<std::vector<std::string_view>> rows;
  };
} // namespace conetact::output

#endif
