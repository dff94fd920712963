// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/former_rows.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace conetact::output
{
  namespace
  {
    std::vector<std::string>
    cells_of(const std::string &line)
    {
      std::vector<std::string> cells(1);
      for (const char c : line)
        if (c == ',')
          cells.emplace_back();
        else
          cells.back() += c;
      return cells;
    }

    /** Where each column of `now` stands in `then`; its size: nowhere. */
    std::vector<std::size_t>
    places(const std::vector<std::string> &now,
           const std::vector<std::string> &then)
    {
      std::vector<std::size_t> at;
      for (const std::string &column : now)
        at.push_back(static_cast<std::size_t>(
          std::find(then.begin(), then.end(), column) - then.begin()));
      return at;
    }

    std::string
    rearranged(const std::string &line, const std::vector<std::size_t> &at)
    {
      const std::vector<std::string> cells = cells_of(line);
      std::string                    text;
      for (const std::size_t place : at)
        text += (text.empty() ? "" : ",") +
                (place < cells.size() ? cells[place] : std::string("0"));
      return text;
    }

    [[noreturn]] void
    refuse(const std::filesystem::path &file, const unsigned int n)
    {
      throw InputError("Option --restart: " + file.string() +
                       " does not hold the increments 1 to " +
                       std::to_string(n) +
                       " of the checkpoint. Run the scene from its start.");
    }
  } // namespace



  std::string
  former_rows(const RunDescription &run,
              const std::string    &table,
              const std::string    &header)
  {
    if (run.n_former == 0)
      return {};
    const std::filesystem::path file = run.former / table;
    std::ifstream               stream(file);
    std::string                 line, rows;
    if (!std::getline(stream, line))
      refuse(file, run.n_former);
    const auto    at   = places(cells_of(trim(header)), cells_of(line));
    const bool    same = line == trim(header);
    unsigned long last = 0;
    while (std::getline(stream, line))
      {
        const unsigned long k = std::strtoul(line.c_str(), nullptr, 10);
        if (k > run.n_former)
          break;
        last = k;
        rows += (same ? line : rearranged(line, at)) + '\n';
      }
    // reactions.csv has no rows where nothing may touch
    if (last != run.n_former && !(last == 0 && table == "reactions.csv"))
      refuse(file, run.n_former);
    return rows;
  }



  void
  check_former_tables(const std::filesystem::path &folder,
                      const unsigned int           n_increments)
  {
    RunDescription run;
    run.former   = folder;
    run.n_former = n_increments;
    for (const char *table : {"reactions.csv", "increments.csv", "history.csv"})
      former_rows(run, table, "increment");
  }
} // namespace conetact::output
