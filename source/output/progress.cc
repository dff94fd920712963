// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/progress.h"

#include <deal.II/base/exceptions.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>

namespace conetact::output
{
  namespace
  {
    std::string
    bar(const double part)
    {
      constexpr unsigned int width = 20;
      const auto             full  = static_cast<unsigned int>(width * part);
      return '[' + std::string(full, '#') + std::string(width - full, ' ') +
             ']';
    }

    // " 7/23", or "7" where their number is not known.
    std::string
    count(const unsigned int done, const unsigned int all)
    {
      const std::string number = std::to_string(done);
      if (all == 0)
        return number;
      const std::string sum = std::to_string(all);
      return std::string(sum.size() - std::min(sum.size(), number.size()),
                         ' ') +
             number + '/' + sum;
    }

    double
    part_done(const model::IncrementRecord &record,
              const unsigned int            n_increments,
              const double                  end)
    {
      const double part = n_increments > 0 ?
                            double(record.increment) / n_increments :
                          end > 0 ? record.time / end :
                                    1.;
      return std::clamp(part, 0., 1.);
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
  progress_line(const model::IncrementRecord &record,
                const unsigned int            n_increments,
                const double                  end,
                const double                  elapsed)
  {
    Assert(record.increment >= 1,
           dealii::ExcMessage("Increments count from 1."));
    std::array<unsigned int, 3> n{};
    for (const model::ContactRow &row : record.rows)
      if (!row.master) // a pair of bodies counts once, as in increments.csv
        ++n.at(static_cast<std::size_t>(row.state));
    const double part = part_done(record, n_increments, end);

    std::array<char, 160> text;
    std::snprintf(
      text.data(),
      text.size(),
      "%s %s  t = %-6.4g open %u, stick %u, slip %u  "
      "%u iterations  %s left",
      bar(part).c_str(),
      count(record.increment, n_increments).c_str(),
      record.time,
      n[0],
      n[1],
      n[2],
      record.report.iterations,
      duration(elapsed * (1 - part) / std::max(part, 1e-3)).c_str());
    return text.data();
  }



  Progress::Progress(const RunDescription &run, const bool quiet)
    : n_increments(run.n_increments)
    , end(run.end)
    , shown(!quiet && ::isatty(STDOUT_FILENO) != 0)
    , start(std::chrono::steady_clock::now())
  {}



  void
  Progress::write(const std::vector<model::IncrementRecord> &finished)
  {
    if (!shown)
      return;
    const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start;
    for (const model::IncrementRecord &record : finished)
      std::cout << progress_line(record, n_increments, end, elapsed.count())
                << std::endl;
  }
} // namespace conetact::output
