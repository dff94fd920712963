// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_former_rows_h
#define conetact_output_former_rows_h

#include "conetact/output/output.h"

#include <string>

namespace conetact::output
{
  /**
   * Rows of a table that a run which is continued left, up to the increment of
   * its checkpoint, in the columns of `header`: those that it did not have are
   * 0, others are left out. Empty if no run is continued. Throws InputError
   * where the table is missing or a row is not whole.
   */
  std::string
  former_rows(const RunDescription &run,
              const std::string    &table,
              const std::string    &header);

  /** Throws InputError where a table of the run to be continued is not what
   * that run wrote up to its checkpoint: rows that are missing or cut,
   * increments out of order, numbers that are not finite. */
  void
  check_former_tables(const std::filesystem::path &folder,
                      const unsigned int           n_increments,
                      const std::size_t            n_reaction_rows);
} // namespace conetact::output

#endif
