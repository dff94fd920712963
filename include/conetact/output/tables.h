// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_tables_h
#define conetact_output_tables_h

#include "conetact/output/increment_table.h"
#include "conetact/output/output.h"
#include "conetact/output/reaction_table.h"

#include <string>

namespace conetact::output
{
  /**
   * `reactions.csv` and `increments.csv`, rewritten from the text of all
   * finished increments once for those that finish together, and replaced
   * together. The constructor writes them without rows, or with those of the
   * run that is continued, so that old tables do not pass for those of this
   * run.
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
    void
    append(const IncrementRecord &record);
    void
    rewrite();

    const std::filesystem::path folder;
    ReactionTable               reactions;
    IncrementTable              increments;
    std::string                 reactions_text, increments_text;
    std::uint64_t               bytes = 0;
  };
} // namespace conetact::output

#endif
