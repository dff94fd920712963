// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/preconditioner.h"

#include <algorithm>

namespace conetact::iterative
{
  const std::vector<PreconditionerRow> &
  preconditioner_table()
  {
    static const std::vector<PreconditionerRow> table = {
      {Preconditioner::aggregation,
       "aggregation",
       "smoothed aggregation in single precision, whose levels follow the "
       "states of contacts"},
      {Preconditioner::trilinos_ml,
       "trilinos ml",
       "smoothed aggregation by Trilinos, built anew for each state; several "
       "times slower and larger, an independent check; of one process"}};
    return table;
  }

  /* The scene has refused all other names. */
  Preconditioner
  preconditioner_named(const std::string &name)
  {
    const auto &table = preconditioner_table();
    return std::find_if(table.begin(),
                        table.end(),
                        [&](const PreconditionerRow &row) {
                          return row.name == name;
                        })
      ->kind;
  }
} // namespace conetact::iterative
