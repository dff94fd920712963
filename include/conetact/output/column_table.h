// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_column_table_h
#define conetact_output_column_table_h

#include <string>

namespace conetact::output
{
  /** How a column of two runs is judged. */
  enum class Judged
  {
    compared, ///< both runs must have the same
    bounded,  ///< residuals and balances: small in both
    counted,  ///< iterations: some more or less are the same
    told      ///< whatever it is
  };

  struct ColumnRule
  {
    Judged judged = Judged::compared;
    /** Columns of one kind have the same units; empty: by itself. */
    std::string kind;
  };

  ColumnRule
  rule_of(const std::string &column);

  /** Differences below this part of the largest value of the same kind are
   * rounding, whatever the column itself has. */
  constexpr double rounding = 1e-12;
} // namespace conetact::output

#endif
