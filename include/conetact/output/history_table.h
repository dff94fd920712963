// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_history_table_h
#define conetact_output_history_table_h

#include "conetact/output/output.h"

#include <string>

namespace conetact::output
{
  /**
   * `history.csv`: a row an increment with what is plotted most: the largest
   * displacement and its body and undeformed place [length], the largest
   * contact pressure [stress] and its contact and place, and the displacement
   * of each chosen point, `NAME_u_x` ... [length]. Written whole each time.
   */
  class HistoryTable : public Output
  {
  public:
    explicit HistoryTable(const RunDescription &description);
    void
    write(const std::vector<IncrementRecord> &finished) override;
    OutputWork
    work() const override;

  private:
    void
    append(const IncrementRecord &record);
    void
    rewrite();

    const RunDescription run;
    std::string          text;
    std::uint64_t        bytes = 0;
  };
} // namespace conetact::output

#endif
