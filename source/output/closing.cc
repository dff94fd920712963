// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/closing.h"

#include "conetact/base/text.h"
#include "conetact/output/csv.h"
#include "conetact/output/extremes.h"

#include <algorithm>
#include <array>

namespace conetact::output
{
  namespace
  {
    /** Contacts, preloads or probes that have a line of their own. */
    constexpr std::size_t most_lines = 4;

    std::string
    states(const RunDescription &run, const model::IncrementRecord &last)
    {
      std::string text = "increment " + std::to_string(last.increment);
      if (run.n_increments > 0)
        text += " of " + std::to_string(run.n_increments);
      text += ", t = " + to_text(last.time);
      if (last.rows.empty())
        return text + ": no contact nodes";
      std::array<unsigned int, 3> n{};
      for (const model::ContactRow &row : last.rows)
        if (!row.master)
          ++n.at(static_cast<std::size_t>(row.state));
      return text + ": " + std::to_string(n[0]) + " contact nodes open, " +
             std::to_string(n[1]) + " stick, " + std::to_string(n[2]) + " slip";
    }

    /** What is rounding noise reads as 0. */
    std::string
    clean(const Tensor<1, 3> &vector, const NoiseFloor &noise)
    {
      Tensor<1, 3> result;
      for (unsigned int d = 0; d < 3; ++d)
        result[d] = noise.clean(vector[d]);
      return to_text(result);
    }

    /** Of an increment, in words. */
    class Resultants
    {
    public:
      Resultants(const RunDescription         &run,
                 const model::IncrementRecord &record)
        : forces(noise_of_forces(record))
        , moments(noise_of_moments(record))
        , tells_moments(run.has_moments)
      {}

      std::string
      operator()(const model::Resultant &resultant) const
      {
        return "force " + clean(resultant.force, forces) +
               (tells_moments ? ", moment about the origin " +
                                  clean(resultant.moment, moments) :
                                "");
      }

    private:
      const NoiseFloor forces, moments;
      const bool       tells_moments;
    };

    template <typename Line>
    void
    add_list(const std::size_t         n,
             const std::string        &more,
             const Line               &line,
             std::vector<std::string> &lines)
    {
      const std::size_t shown = n > most_lines + 1 ? most_lines : n;
      for (std::size_t i = 0; i < shown; ++i)
        lines.push_back(line(i));
      if (n > shown)
        lines.push_back("  and " + std::to_string(n - shown) +
                        " more: " + more);
    }

    /** Tension of what a preload tightens: bolts. */
    std::string
    tension(const std::string &name, const model::PreloadRecord &preload)
    {
      return "preload of " + name + ": tension " + to_text(preload.force) +
             ", shortened by " + to_text(preload.shortening);
    }

    /** Supports and loads together; the table has each. */
    std::string
    external(const RunDescription         &run,
             const model::IncrementRecord &last,
             const Resultants             &text)
    {
      std::vector<std::string> parts;
      if (!run.supports.empty())
        parts.push_back("supports: " + text(last.supports));
      if (!run.loads.empty())
        parts.push_back("loads: " + text(last.loads));
      return join(parts);
    }
  } // namespace



  std::vector<std::string>
  closing_lines(const RunDescription         &run,
                const model::IncrementRecord &last,
                const std::set<unsigned int> &faceted)
  {
    const Resultants         resultant(run, last);
    std::vector<std::string> lines = {states(run, last)};
    add_list(
      std::min(run.contacts.size(), last.contacts.size()),
      "increments.csv",
      [&](const std::size_t c) {
        return "contact " + run.contacts[c] + ": " +
               resultant(last.contacts[c]);
      },
      lines);
    add_list(
      std::min(run.preloads.size(), last.preloads.size()),
      "increments.csv",
      [&](const std::size_t k) {
        return tension(run.preloads[k], last.preloads[k]);
      },
      lines);
    if (const std::string line = external(run, last, resultant); !line.empty())
      lines.push_back(line);
    if (const model::LargestDisplacement &moved = last.largest_displacement;
        moved.size > 0)
      lines.push_back("largest displacement: " + to_text(moved.size) +
                      ", body " + run.bodies.at(moved.body) + " at " +
                      to_text(moved.position));
    if (const LargestPressure pressed = largest_pressure(last);
        pressed.pressure > 0)
      lines.push_back("largest pressure: " + to_text(pressed.pressure) +
                      ", contact " + run.contacts.at(pressed.contact) + " at " +
                      to_text(pressed.position) +
                      (faceted.count(pressed.contact) > 0 ?
                         ", made uneven by facets (see the warning)" :
                         ""));
    add_list(
      std::min(run.probes.size(), last.probes.size()),
      "history.csv",
      [&](const std::size_t p) {
        return "probe " + run.probes[p] + ": displacement " +
               to_text(last.probes[p]);
      },
      lines);
    return lines;
  }



  std::string
  files_written(const std::filesystem::path &folder)
  {
    std::vector<std::string> found;
    for (const char *name : {"increments.csv",
                             "reactions.csv",
                             "history.csv",
                             "events.csv",
                             "scene.pvd",
                             "log.txt"})
      if (std::filesystem::exists(folder / name))
        found.emplace_back(name);
    return "Results are in " + folder.string() + ": " + join(found);
  }
} // namespace conetact::output
