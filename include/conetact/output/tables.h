// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_tables_h
#define conetact_output_tables_h

#include "conetact/base/growing_file.h"
#include "conetact/output/increment_table.h"
#include "conetact/output/output.h"
#include "conetact/output/reaction_table.h"

#include <cstdint>
#include <optional>

namespace conetact::output
{
  /**
   * `reactions.csv` and `increments.csv`, which grow together, once for
   * increments that finish together, and `reactions-2.csv` of increments that
   * have another solution, `solutions.csv` of all of them. The constructor
   * writes them without rows, or with those of the run that is continued, so
   * that old tables do not pass for those of this run.
   */
  class Tables : public Output
  {
  public:
    explicit Tables(const RunDescription &run);
    /** Throws AnalysisError at a number that is not finite. */
    void
    write(const std::vector<IncrementRecord> &finished) override;
    OutputWork
    work() const override;

  private:
    ReactionTable  reactions;
    IncrementTable increments;
    GrowingFile    reactions_file, increments_file;
    /** Other solutions, where they are looked for. */
    std::optional<GrowingFile> others_file;
    std::optional<GrowingFile> branches_file; ///< the same, of all
    std::uint64_t beginning = 0; ///< bytes that the constructor wrote
  };
} // namespace conetact::output

#endif
