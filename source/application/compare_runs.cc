// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/compare_runs.h"

#include "conetact/application/scene_text.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/output/comparison.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace conetact::application
{
  namespace
  {
    using output::ColumnDifference;
    using output::Comparison;

    /** Rows of the table of differences; a large scene has hundreds. */
    constexpr std::size_t most_columns = 30;

    /** Of a run, as its used.prm says; that of the limits without it. */
    double
    tolerance_of_run(const std::filesystem::path &folder,
                     const double                 otherwise)
    {
      std::ifstream     file(folder / "used.prm");
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      const Entries     entries = entries_of(text);
      const auto        found   = entries.find("Solver/Tolerance");
      return found == entries.end() ?
               otherwise :
               to_number(found->second, "Solver, Tolerance");
    }

    using Cells = std::vector<std::string>;

    Cells
    cells(const ColumnDifference &column)
    {
      const std::string judged = column.is_beyond ? "differs" :
                                 column.is_told   ? "told only" :
                                                    "equal";
      const bool        text   = column.is_text;
      return {column.table,
              column.column,
              std::to_string(column.n_rows),
              text ? "-" : to_text(column.largest),
              text ? "-" : to_text(column.difference),
              text ? "-" : to_text(column.relative()),
              judged,
              column.where + ": " + column.one + ", " + column.other};
    }

    /** Columns below each other, the last one as long as it is. */
    std::string
    in_columns(const std::vector<Cells> &rows)
    {
      std::vector<std::size_t> width(rows[0].size(), 0);
      for (const Cells &row : rows)
        for (std::size_t c = 0; c < row.size(); ++c)
          width[c] = std::max(width[c], row[c].size());
      std::string text;
      for (const Cells &row : rows)
        {
          for (std::size_t c = 0; c + 1 < row.size(); ++c)
            text += row[c] + std::string(width[c] + 2 - row[c].size(), ' ');
          text += row.back() + '\n';
        }
      return text;
    }

    /** What differs first, then by how much. */
    bool
    is_worse(const ColumnDifference &a, const ColumnDifference &b)
    {
      const auto rank = [](const ColumnDifference &c) {
        return c.is_beyond ? 0 : c.is_told ? 2 : 1;
      };
      return rank(a) != rank(b) ? rank(a) < rank(b) :
                                  a.relative() > b.relative();
    }

    std::string
    table_of(std::vector<ColumnDifference> columns)
    {
      if (columns.empty())
        return "";
      std::stable_sort(columns.begin(), columns.end(), is_worse);
      std::vector<Cells> rows = {{"table",
                                  "column",
                                  "rows",
                                  "largest",
                                  "difference",
                                  "relative",
                                  "judged",
                                  "where"}};
      for (std::size_t i = 0; i < std::min(columns.size(), most_columns); ++i)
        rows.push_back(cells(columns[i]));
      std::string text =
        "\nlargest differences by column:\n" + in_columns(rows);
      if (columns.size() > most_columns)
        text += std::to_string(columns.size() - most_columns) +
                " more columns differ less\n";
      return text;
    }

    std::string
    heading(const Comparison               &found,
            const CommandLine              &line,
            const output::ComparisonLimits &limits)
    {
      const std::string runs =
        line.compared[0].string() + " and " + line.compared[1].string();
      if (found.first.empty())
        return runs + " are equal to " + to_text(limits.tolerance) + ": " +
               std::to_string(found.n_tables) + " tables, " +
               std::to_string(found.n_rows) + " rows\n";
      std::string text = runs + " differ by more than " +
                         to_text(limits.tolerance) + "\nfirst: " + found.first +
                         '\n';
      for (const std::string &missing : found.missing)
        if (missing != found.first)
          text += missing + '\n';
      return text;
    }
  } // namespace



  RunComparison
  compare_runs(const CommandLine &line)
  {
    output::ComparisonLimits limits;
    limits.tolerance        = line.tolerance.value_or(limits.tolerance);
    const double by_default = limits.bound;
    for (const auto &folder : line.compared)
      limits.bound =
        std::max(limits.bound, tolerance_of_run(folder, by_default));
    const Comparison found =
      output::compare_results(line.compared[0], line.compared[1], limits);
    return {line.quiet ? "" :
                         heading(found, line, limits) + table_of(found.columns),
            found.first.empty()};
  }
} // namespace conetact::application
