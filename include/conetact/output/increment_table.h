// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_increment_table_h
#define conetact_output_increment_table_h

#include "conetact/output/output.h"

#include <string>

namespace conetact::output
{
  /**
   * `increments.csv`: one row an increment: how it was solved, how well
   * equilibrium holds, how many nodes are in which state, the force [force]
   * and moment about the origin [force x length] of each contact, of the
   * supports and of the loads together and one by one, and the energies [force
   * x length]. Columns of a support or load begin with `support_NAME` or
   * `load_NAME`, because a contact, a support and a load may share a name.
   * Those of an obstacle that is free, `obstacle_NAME`, come last: its motion
   * [length; rad] and what contacts do to it.
   */
  class IncrementTable
  {
  public:
    explicit IncrementTable(const RunDescription &description);
    std::string
    header() const;
    /** Throws AnalysisError at a number that is not finite. */
    std::string
    row(const model::IncrementRecord &record) const;

  private:
    class Columns;
    /** All columns, in their order: a name and what the record has for it. */
    void
    fill(const model::IncrementRecord &record, Columns &columns) const;
    void
    fill_external(const model::IncrementRecord &record, Columns &columns) const;
    void
    fill_further(const model::IncrementRecord &record, Columns &columns) const;

    const RunDescription run;
  };
} // namespace conetact::output

#endif
