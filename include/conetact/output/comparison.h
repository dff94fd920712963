// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_comparison_h
#define conetact_output_comparison_h

#include <filesystem>
#include <string>
#include <vector>

namespace conetact::output
{
  /** How much two runs may differ and be equal all the same. */
  struct ComparisonLimits
  {
    /** Of numbers, over the largest of their column in both runs. */
    double tolerance = 1e-9;
    /** Of residuals and balances, which are rounding: one run may have so much
     * more of it than the other. */
    double bound = 1e-10;
  };

  /** What two runs have in a column, if that is not the same. */
  struct ColumnDifference
  {
    std::string table, column;
    std::string where;      ///< the row of the largest difference
    std::string one, other; ///< what stands there
    double      largest = 0, difference = 0; ///< of numbers
    std::size_t n_rows    = 0;               ///< that differ at all
    bool        is_text   = false;
    bool        is_told   = false; ///< of solvers: bounded, not compared
    bool        is_beyond = false; ///< what is allowed

    /** Over the largest of the column. */
    double
    relative() const
    {
      return largest > 0 ? difference / largest : 0;
    }
  };

  /** What two folders of results have in common and what not. */
  struct Comparison
  {
    std::string                   first; ///< what differs first; empty: nothing
    std::vector<std::string>      missing; ///< tables, columns, rows of one run
    std::vector<ColumnDifference> columns;
    std::size_t                   n_tables = 0, n_rows = 0; ///< in both
  };

  /**
   * Compares all tables (CSV) of two folders. Rows are matched by what names
   * them, as increment, contact and node, not by their place. Throws InputError
   * where a folder has no table, or one that cannot be read.
   */
  Comparison
  compare_results(const std::filesystem::path &one,
                  const std::filesystem::path &other,
                  const ComparisonLimits      &limits);
} // namespace conetact::output

#endif
