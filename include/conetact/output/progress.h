// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_progress_h
#define conetact_output_progress_h

#include "conetact/output/output.h"

#include <chrono>
#include <string>

namespace conetact::output
{
  /**
   * One line with a progress bar for each finished increment on a terminal;
   * nothing when standard output is a pipe or a file, or `quiet` is set.
   */
  class Progress : public Output
  {
  public:
    Progress(const RunDescription &run, const bool quiet);
    void
    write(const std::vector<model::IncrementRecord> &finished) override;

  private:
    const unsigned int                          n_increments;
    const double                                end;
    const bool                                  shown;
    const std::chrono::steady_clock::time_point start;
  };

  /**
   * "[####      ]  7/23  t = 7  open 24, stick 20, slip 7  5 iterations
   * 12 s left", with `elapsed` seconds since the start. Where the number of
   * increments is not known (`n_increments` is 0, a load path) the bar shows
   * the time, which ends at `end`.
   */
  std::string
  progress_line(const model::IncrementRecord &record,
                const unsigned int            n_increments,
                const double                  end,
                const double                  elapsed);
} // namespace conetact::output

#endif
