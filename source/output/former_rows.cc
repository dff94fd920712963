// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/former_rows.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/output/table_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <utility>

namespace conetact::output
{
  namespace
  {
    std::vector<std::string>
    names_in(const std::string &line)
    {
      const auto cells = cells_of(line);
      return {cells.begin(), cells.end()};
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
      const auto  cells = cells_of(line);
      std::string text;
      for (const std::size_t place : at)
        text.append(text.empty() ? "" : ",")
          .append(place < cells.size() ? cells[place] : "0");
      return text;
    }

    bool
    is_text(const std::string &column)
    {
      const auto ends = [&column](const std::string &end) {
        return column.size() >= end.size() &&
               column.compare(column.size() - end.size(), end.size(), end) == 0;
      };
      return column == "contact" || column == "state" || column == "solver" ||
             column == "determinate" || column == "unique" || ends("_body") ||
             ends("_contact");
    }

    [[noreturn]] void
    refuse(const std::filesystem::path &file, const std::string &why)
    {
      throw InputError("Option --restart: " + file.string() + ' ' + why +
                       ". Take a copy of the folder that is whole, or run the "
                       "scene from its start.");
    }

    /** Increments in which supports hold all nodes have none there. */
    bool
    may_skip_increments(const std::string &table)
    {
      return table == "reactions.csv";
    }

    /** A table of former results, row by row up to an increment. */
    class FormerTable
    {
    public:
      FormerTable(const std::filesystem::path &folder,
                  const std::string           &table,
                  const unsigned int           last)
        : file(folder / table)
        , stream(file)
        , n_increments(last)
        , may_skip(may_skip_increments(table))
      {
        if (!std::getline(stream, line))
          refuse(file, "is missing or empty");
        columns = names_in(line);
      }

      const std::vector<std::string> &
      header() const
      {
        return columns;
      }

      /** Goes to the next row, which must be whole; false: there is none. */
      bool
      next()
      {
        ++number;
        if (!std::getline(stream, line))
          return false;
        const unsigned long k       = std::strtoul(line.c_str(), nullptr, 10);
        const bool          is_torn = stream.eof(); // by a kill
        if (k > n_increments || (is_torn && increment == n_increments))
          return false;
        if (k < increment || (!may_skip && k > increment + 1))
          refuse(file,
                 "has in line " + std::to_string(number) + " increment " +
                   std::to_string(k) + " behind increment " +
                   std::to_string(increment));
        increment = k;
        check_cells();
        ++rows;
        return true;
      }

      void
      check_last() const
      {
        if (increment != n_increments && !may_skip)
          refuse(file,
                 "does not hold the increments 1 to " +
                   std::to_string(n_increments) + " of the checkpoint");
      }

      void
      check_number(const std::size_t expected) const
      {
        if (rows != expected)
          refuse(file,
                 "has " + std::to_string(rows) + " rows of the increments 1 " +
                   "to " + std::to_string(n_increments) +
                   " of the checkpoint instead of " + std::to_string(expected));
      }

      std::string line;

    private:
      void
      check_cells() const
      {
        const std::string where = "has in line " + std::to_string(number) + ' ';
        const auto        cells = cells_of(line);
        if (cells.size() != columns.size())
          refuse(file,
                 where + std::to_string(cells.size()) + " columns instead of " +
                   std::to_string(columns.size()));
        if (stream.eof())
          refuse(file, where + "no end of the line");
        for (std::size_t i = 0; i < cells.size(); ++i)
          if (!is_text(columns[i]) && !finite_number(cells[i]))
            refuse(file,
                   where + '\'' + std::string(cells[i]) + "' for " +
                     columns[i] + ", which is no finite number");
      }

      std::filesystem::path    file;
      std::ifstream            stream;
      std::vector<std::string> columns;
      unsigned long            n_increments, increment = 0;
      bool                     may_skip;
      std::size_t              number = 1, rows = 0;
    };
  } // namespace



  std::string
  former_rows(const RunDescription &run,
              const std::string    &table,
              const std::string    &header)
  {
    if (run.n_former == 0)
      return {};
    FormerTable former(run.former, table, run.n_former);
    const auto  now  = names_in(trim(header));
    const auto  at   = places(now, former.header());
    const bool  same = now == former.header();
    std::string rows;
    while (former.next())
      rows += (same ? former.line : rearranged(former.line, at)) + '\n';
    former.check_last();
    return rows;
  }



  void
  check_former_tables(const std::filesystem::path &folder,
                      const unsigned int           n_increments,
                      const std::size_t            n_reaction_rows)
  {
    const std::pair<const char *, std::size_t> tables[] = {
      {"reactions.csv", n_reaction_rows},
      {"increments.csv", n_increments},
      {"history.csv", n_increments}};
    for (const auto &[table, n_rows] : tables)
      {
        FormerTable former(folder, table, n_increments);
        while (former.next())
          ;
        former.check_last();
        former.check_number(n_rows);
      }
  }
} // namespace conetact::output
