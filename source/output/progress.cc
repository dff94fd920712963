// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/progress.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>

namespace conetact
{
  namespace
  {
    std::string
    bar(const unsigned int done, const unsigned int all)
    {
      constexpr unsigned int width = 20;
      const unsigned int     full =
        all == 0 ? width : std::min(width, width * done / all);
      return '[' + std::string(full, '#') + std::string(width - full, ' ') +
             ']';
    }

    std::string
    duration(const double seconds)
    {
      const auto s = static_cast<unsigned long>(seconds + .5);
      if (s < 100)
        return std::to_string(s) + " s";
      if (s < 6000)
        return std::to_string((s + 30) / 60) + " min";
      return std::to_string((s + 1800) / 3600) + " h";
    }
  } // namespace



  std::string
  progress_line(const IncrementRecord &record,
                const unsigned int     n_increments,
                const double           elapsed)
  {
    std::array<unsigned int, 3> n{};
    for (const ContactRow &row : record.rows)
      ++n.at(static_cast<std::size_t>(row.state));
    const unsigned int done = std::max(1u, record.increment);
    const unsigned int left = n_increments - std::min(n_increments, done);

    std::array<char, 160> text;
    std::snprintf(text.data(),
                  text.size(),
                  "%s %*u/%u  t = %-6.4g open %u, stick %u, slip %u  "
                  "%u iterations  %s left",
                  bar(record.increment, n_increments).c_str(),
                  static_cast<int>(std::to_string(n_increments).size()),
                  record.increment,
                  n_increments,
                  record.time,
                  n[0],
                  n[1],
                  n[2],
                  record.report.iterations,
                  duration(elapsed / done * left).c_str());
    return text.data();
  }



  Progress::Progress(const RunDescription &run, const bool quiet)
    : n_increments(run.n_increments)
    , shown(!quiet && ::isatty(STDOUT_FILENO) != 0)
    , start(std::chrono::steady_clock::now())
  {}



  void
  Progress::write(const std::vector<IncrementRecord> &finished)
  {
    if (!shown)
      return;
    const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start;
    for (const IncrementRecord &record : finished)
      std::cout << progress_line(record, n_increments, elapsed.count())
                << std::endl;
  }
} // namespace conetact
