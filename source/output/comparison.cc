// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/comparison.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/output/column_table.h"
#include "conetact/output/table_cells.h"
#include "conetact/output/table_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

namespace conetact::output
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Columns that name a row; those of them that a table has. */
    const char *const naming[] = {"increment",
                                  "event",
                                  "mesh",
                                  "contact",
                                  "node"};

    /** Tables that people look at first; all others follow by their names. */
    const char *const first_tables[] = {"increments.csv",
                                        "reactions.csv",
                                        "history.csv",
                                        "events.csv"};

    /** What a table has where nothing is to be told, as of gaps to nothing. */
    constexpr std::string_view nothing = "nan";

    /** Rows by what names them: "increment 3, contact sole, node 12". */
    class NamedRows
    {
    public:
      explicit NamedRows(const TableFile &t)
        : table(t)
      {
        for (const char *const name : naming)
          if (const auto column = table.column(name))
            columns.push_back(*column);
        for (std::size_t i = 0; i < table.n_rows(); ++i)
          {
            std::string name = name_of(i);
            const auto  n    = ++seen[name];
            if (n > 1) // as two changes of one event
              name += " (" + std::to_string(n) + ")";
            places.emplace(name, i);
            names.push_back(std::move(name));
          }
      }

      const std::string &
      name(const std::size_t row) const
      {
        return names[row];
      }

      std::optional<std::size_t>
      find(const std::string &name) const
      {
        const auto found = places.find(name);
        if (found == places.end())
          return {};
        return found->second;
      }

      bool
      is_named_by(const std::size_t column) const
      {
        return std::find(columns.begin(), columns.end(), column) !=
               columns.end();
      }

    private:
      std::string
      name_of(const std::size_t row) const
      {
        std::string name;
        for (const std::size_t c : columns)
          if (!table.cell(row, c).empty())
            name.append(name.empty() ? "" : ", ")
              .append(table.columns()[c])
              .append(" ")
              .append(table.cell(row, c));
        return name.empty() ? "row " + std::to_string(row + 1) : name;
      }

      const TableFile                             &table;
      std::vector<std::size_t>                     columns;
      std::vector<std::string>                     names;
      std::unordered_map<std::string, std::size_t> places, seen;
    };

    /** A column of both tables, as it is compared. */
    struct Pair
    {
      std::size_t      one, other; ///< its places
      ColumnRule       rule;
      bool             is_number = true;
      double           of_kind = 0; ///< the largest of all columns of its kind
      ColumnDifference found;
    };

    /** A table that both runs have. */
    class TwoTables
    {
    public:
      TwoTables(std::string             table,
                const fs::path         &a,
                const fs::path         &b,
                const ComparisonLimits &l,
                const double            longest_lever)
        : name(std::move(table))
        , one(a / name)
        , other(b / name)
        , rows_one(one)
        , rows_other(other)
        , limits(l)
        , lever(longest_lever)
        , folder_one(a.string())
        , folder_other(b.string())
      {}

      void
      compare(Comparison &result)
      {
        pair_columns(result);
        measure_columns();
        for (std::size_t i = 0; i < one.n_rows(); ++i)
          if (const auto j = rows_other.find(rows_one.name(i)))
            compare_rows(i, *j, result);
          else if (n_lost++ == 0)
            first_lost = rows_one.name(i);
        say_lost(folder_one, n_lost, first_lost, result);
        say_new(result);
        for (Pair &pair : pairs)
          if (pair.found.n_rows > 0)
            result.columns.push_back(std::move(pair.found));
      }

    private:
      void
      pair_columns(Comparison &result)
      {
        for (std::size_t c = 0; c < one.columns().size(); ++c)
          if (const auto there = other.column(one.columns()[c]))
            {
              const std::string column(one.columns()[c]);
              Pair              pair;
              pair.one          = c;
              pair.other        = *there;
              pair.rule         = rule_of(column);
              pair.found.table  = name;
              pair.found.column = column;
              if (!rows_one.is_named_by(c))
                pairs.push_back(std::move(pair));
            }
          else
            say_missing("column " + std::string(one.columns()[c]),
                        folder_one,
                        result);
        for (const std::string_view column : other.columns())
          if (!one.column(column))
            say_missing("column " + std::string(column), folder_other, result);
      }

      /** Text where a cell is no number; else the largest of both runs. */
      void
      measure_columns()
      {
        std::map<std::string, double> kinds;
        for (Pair &pair : pairs)
          {
            see(one, pair.one, pair);
            see(other, pair.other, pair);
            pair.found.is_text = !pair.is_number;
            pair.found.is_told = pair.rule.judged != Judged::compared;
            double &kind       = kinds[pair.rule.kind];
            if (!pair.rule.kind.empty())
              kind = std::max(kind, pair.found.largest);
          }
        // Moments that cancel have the rounding of forces times their levers.
        kinds["moments"] = std::max(kinds["moments"], kinds["forces"] * lever);
        for (Pair &pair : pairs)
          pair.of_kind = kinds[pair.rule.kind];
      }

      static void
      see(const TableFile &table, const std::size_t column, Pair &pair)
      {
        for (std::size_t i = 0; pair.is_number && i < table.n_rows(); ++i)
          if (const auto value = finite_number(table.cell(i, column)))
            pair.found.largest = std::max(pair.found.largest, std::abs(*value));
          else if (table.cell(i, column) != nothing)
            pair.is_number = false;
      }

      /** Of cells that differ; a number differs from nothing without measure.
       */
      static double
      difference_of(const Pair            &pair,
                    const std::string_view a,
                    const std::string_view b)
      {
        if (!pair.is_number)
          return 0;
        if (a == nothing || b == nothing)
          return std::numeric_limits<double>::infinity();
        return std::abs(*finite_number(a) - *finite_number(b));
      }

      void
      compare_rows(const std::size_t i, const std::size_t j, Comparison &result)
      {
        ++result.n_rows;
        for (Pair &pair : pairs)
          {
            const std::string_view a = one.cell(i, pair.one);
            const std::string_view b = other.cell(j, pair.other);
            if (a == b)
              continue;
            const double difference = difference_of(pair, a, b);
            const bool   beyond     = is_beyond(pair, a, b, difference, i, j);
            take(pair, a, b, difference, rows_one.name(i), beyond);
            if (beyond && result.first.empty())
              result.first = name + ", " + rows_one.name(i) + ": " +
                             pair.found.column + " is " + std::string(a) +
                             " and " + std::string(b) +
                             what_is_wrong(pair, difference);
          }
      }

      std::string
      what_is_wrong(const Pair &pair, const double difference) const
      {
        if (pair.rule.judged == Judged::bounded)
          return ", more than " + to_text(limits.bound);
        if (pair.rule.judged == Judged::counted)
          return ", more than twice as many and 5";
        if (!pair.is_number || !std::isfinite(difference))
          return "";
        return ", a difference of " + to_text(difference) + ", " +
               to_text(difference / pair.found.largest) +
               " of the largest of the column, " + to_text(pair.found.largest);
      }

      static void
      take(Pair                  &pair,
           const std::string_view a,
           const std::string_view b,
           const double           difference,
           const std::string     &where,
           const bool             beyond)
      {
        ColumnDifference &found = pair.found;
        ++found.n_rows;
        const bool is_worse =
          beyond > found.is_beyond ||
          (beyond == found.is_beyond && difference > found.difference);
        if (found.n_rows > 1 && !is_worse)
          return;
        found.difference = difference;
        found.where      = where;
        found.one        = a;
        found.other      = b;
        found.is_beyond  = beyond;
      }

      bool
      is_beyond(const Pair            &pair,
                const std::string_view a,
                const std::string_view b,
                const double           difference,
                const std::size_t      i,
                const std::size_t      j) const
      {
        const bool       is_number = pair.is_number;
        constexpr double many = 2, some = 5;
        switch (pair.rule.judged)
          {
            case Judged::told:
              return false;
            case Judged::bounded:
              return !is_number || difference > limits.bound;
            case Judged::counted:
              {
                if (!is_number || !std::isfinite(difference) ||
                    !same_solver(i, j))
                  return false;
                const auto [least, most] =
                  std::minmax(*finite_number(a), *finite_number(b));
                return most > many * least + some;
              }
            case Judged::compared:
              break;
          }
        return is_number ? difference > allowed(pair) : a != b;
      }

      /** What is 0 but for rounding has a column of rounding, which is small
       * beside others of its kind. */
      double
      allowed(const Pair &pair) const
      {
        return std::max(limits.tolerance * pair.found.largest,
                        std::min(limits.tolerance, rounding) * pair.of_kind);
      }

      bool
      same_solver(const std::size_t i, const std::size_t j) const
      {
        const auto a = one.column("solver"), b = other.column("solver");
        return !a || !b || one.cell(i, *a) == other.cell(j, *b);
      }

      void
      say_missing(const std::string &what,
                  const std::string &folder,
                  Comparison        &result) const
      {
        result.missing.push_back(name + ": " + what + " is in " + folder +
                                 " only");
        if (result.first.empty())
          result.first = result.missing.back();
      }

      void
      say_lost(const std::string &folder,
               const std::size_t  n,
               const std::string &lost,
               Comparison        &result) const
      {
        if (n > 0)
          say_missing(n == 1 ? "the row of " + lost :
                               std::to_string(n) + " rows, the first one of " +
                                 lost + ",",
                      folder,
                      result);
      }

      void
      say_new(Comparison &result) const
      {
        std::size_t n = 0;
        std::string lost;
        for (std::size_t j = 0; j < other.n_rows(); ++j)
          if (!rows_one.find(rows_other.name(j)) && n++ == 0)
            lost = rows_other.name(j);
        say_lost(folder_other, n, lost, result);
      }

      const std::string       name;
      const TableFile         one, other;
      const NamedRows         rows_one, rows_other;
      const ComparisonLimits &limits;
      const double            lever; ///< of forces that make moments [length]
      const std::string       folder_one, folder_other;
      std::vector<Pair>       pairs;
      std::size_t             n_lost = 0;
      std::string             first_lost;
    };

    /** The largest coordinate of a contact node. */
    double
    longest_lever(const fs::path &folder)
    {
      double longest = 0;
      if (!fs::exists(folder / "reactions.csv"))
        return longest;
      const TableFile table(folder / "reactions.csv");
      for (const char *const place : {"x", "y", "z"})
        if (const auto column = table.column(place))
          for (std::size_t i = 0; i < table.n_rows(); ++i)
            if (const auto value = finite_number(table.cell(i, *column)))
              longest = std::max(longest, std::abs(*value));
      return longest;
    }

    /** Names of the tables of a folder. */
    std::set<std::string>
    tables_in(const fs::path &folder)
    {
      std::error_code error;
      if (!fs::is_directory(folder, error))
        throw InputError("There is no folder " + folder.string() +
                         ". Give two folders of results, as output/SCENE.");
      std::set<std::string> tables;
      for (fs::directory_iterator file(folder, error), end;
           !error && file != end;
           file.increment(error))
        if (file->path().extension() == ".csv")
          tables.insert(file->path().filename().string());
      if (tables.empty())
        throw InputError("The folder " + folder.string() +
                         " holds no table (.csv)" +
                         (error ? ": " + error.message() : std::string()) +
                         ". Give two folders of results, as output/SCENE.");
      return tables;
    }

    std::vector<std::string>
    in_order(const std::set<std::string> &tables)
    {
      std::vector<std::string> order;
      for (const char *const name : first_tables)
        if (tables.count(name) > 0)
          order.emplace_back(name);
      for (const std::string &name : tables)
        if (std::find(order.begin(), order.end(), name) == order.end())
          order.push_back(name);
      return order;
    }
  } // namespace



  Comparison
  compare_results(const fs::path         &one,
                  const fs::path         &other,
                  const ComparisonLimits &limits)
  {
    const auto            in_one = tables_in(one), in_other = tables_in(other);
    std::set<std::string> all = in_one;
    all.insert(in_other.begin(), in_other.end());
    const double lever = std::max(longest_lever(one), longest_lever(other));
    Comparison   result;
    for (const std::string &table : in_order(all))
      if (in_one.count(table) > 0 && in_other.count(table) > 0)
        {
          ++result.n_tables;
          TwoTables(table, one, other, limits, lever).compare(result);
        }
      else
        {
          result.missing.push_back(
            "the table " + table + " is in " +
            (in_one.count(table) > 0 ? one : other).string() + " only");
          if (result.first.empty())
            result.first = result.missing.back();
        }
    return result;
  }
} // namespace conetact::output
