// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/table_file.h"

#include "conetact/base/errors.h"
#include "conetact/output/table_cells.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace conetact::output
{
  namespace
  {
    [[noreturn]] void
    refuse_table(const std::filesystem::path &file, const std::string &why)
    {
      throw InputError("The table " + file.string() + ' ' + why +
                       ". Give folders of results that are whole.");
    }

    std::string
    text_of_table(const std::filesystem::path &file)
    {
      std::ifstream stream(file, std::ios::binary);
      std::string   text{std::istreambuf_iterator<char>(stream), {}};
      if (!stream.is_open() || stream.bad())
        refuse_table(file, "cannot be read");
      if (text.empty() || text.find('\0') != text.npos)
        refuse_table(file, text.empty() ? "is empty" : "is no text");
      if (text.back() != '\n')
        refuse_table(file, "ends within a line");
      return text;
    }
  } // namespace



  TableFile::TableFile(const std::filesystem::path &file)
    : text(text_of_table(file))
  {
    const std::string_view all    = text;
    std::size_t            number = 0;
    for (std::size_t begin = 0, end; begin < all.size(); begin = end + 1)
      {
        end                   = all.find('\n', begin);
        std::string_view line = all.substr(begin, end - begin);
        if (!line.empty() && line.back() == '\r')
          line.remove_suffix(1);
        if (++number == 1)
          {
            names = cells_of(line);
            continue;
          }
        rows.push_back(cells_of(line));
        if (const std::size_t n = rows.back().size(); n != names.size())
          refuse_table(file,
                       "has in line " + std::to_string(number) + ' ' +
                         std::to_string(n) + " columns instead of " +
                         std::to_string(names.size()));
      }
  }



  std::optional<std::size_t>
  TableFile::column(const std::string_view name) const
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      return {};
    return static_cast<std::size_t>(found - names.begin());
  }
} // namespace conetact::output
