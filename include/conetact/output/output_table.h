// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_output_table_h
#define conetact_output_output_table_h

#include "conetact/output/output.h"

namespace conetact::output
{
  /** One row for each kind of output. */
  struct OutputRow
  {
    const char *name;
    const char *description;
    std::unique_ptr<Output> (*create)(const RunDescription &);
    bool is_shared = false; ///< see Output
  };
  const std::vector<OutputRow> &
  output_table();
} // namespace conetact::output

#endif
