// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_tables_h
#define conetact_output_tables_h

#include "conetact/output/increment_table.h"
#include "conetact/output/output.h"
#include "conetact/output/reaction_table.h"

#include <cstdint>
#include <filesystem>

namespace conetact::output
{
  /**
   * `reactions.csv` and `increments.csv`, which grow by the rows of increments
   * that finish together, the latter last, and `reactions-2.csv` of increments
   * that have another solution, `solutions.csv` of all of them. The constructor
   * writes them without rows, or with those of the run that is continued, so
   * that old tables do not pass for those of this run.
   */
  class Tables : public Output
  {
  public:
    explicit Tables(const RunDescription &run);
    /** Throws AnalysisError at a number that is not finite. */
    void
    write(const std::vector<model::IncrementRecord> &finished) override;
    OutputWork
    work() const override;

  private:
    ReactionTable               reactions;
    IncrementTable              increments;
    const std::filesystem::path folder;
    /** Of other solutions, where they are looked for; and of all of them. */
    const bool    has_others, has_branches;
    std::uint64_t n_bytes = 0; ///< of the first two tables, written so far
  };
} // namespace conetact::output

#endif
