// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_history_table_h
#define conetact_output_history_table_h

#include "conetact/output/output.h"

#include <cstdint>
#include <string>

namespace conetact::output
{
  /**
   * `history.csv`: a row an increment with what is plotted most: the largest
   * displacement and its body and undeformed place [length], the largest
   * contact pressure [stress] and its contact and place, and the displacement
   * of each chosen point, `NAME_u_x` ... [length].
   */
  class HistoryTable : public Output
  {
  public:
    explicit HistoryTable(const RunDescription &description);
    void
    write(const std::vector<model::IncrementRecord> &finished) override;
    OutputWork
    work() const override;

  private:
    void
    append(const model::IncrementRecord &record, std::string &text) const;

    const RunDescription run;
    std::uint64_t        n_bytes = 0; ///< written so far
  };
} // namespace conetact::output

#endif
