// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_preconditioner_h
#define conetact_iterative_preconditioner_h

#include <string>
#include <vector>

namespace conetact::iterative
{
  /** What makes the levels below the finest one. */
  enum class Preconditioner
  {
    aggregation, ///< CoarseLevels
    trilinos_ml  ///< TrilinosLevels
  };

  struct PreconditionerRow
  {
    Preconditioner kind;
    const char    *name, *description;
  };
  /** The default first. */
  const std::vector<PreconditionerRow> &
  preconditioner_table();
  /** Of a name in the table. */
  Preconditioner
  preconditioner_named(const std::string &name);
} // namespace conetact::iterative

#endif
