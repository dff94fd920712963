// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/load_history.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

namespace conetact::application
{
  namespace
  {
    /** Appends n equal increments that end at `end`. */
    void
    append_stage(std::vector<double> &times, const double end, const double n)
    {
      const double start = times.empty() ? 0. : times.back();
      if (!(end > start))
        throw InputError("Time: an increment ends at t = " + to_text(end) +
                         ", not after t = " + to_text(start) +
                         " where it starts. Give ascending times above 0.");
      if (n < 1 || n > 1e7 || n != static_cast<double>(static_cast<long>(n)))
        throw InputError("Time: " + to_text(n) +
                         " increments are asked for. "
                         "Give a whole number from 1 to 10000000.");
      for (long k = 1; k <= static_cast<long>(n); ++k)
        times.push_back(k == static_cast<long>(n) ?
                          end :
                          start + (end - start) * static_cast<double>(k) / n);
    }
    /** End and Increments are of no use beside times that are listed. */
    void
    refuse_idle(const dealii::ParameterHandler &prm,
                const std::string              &list,
                const double                    end)
    {
      const auto refuse = [&list](const std::string &entry) {
        throw InputError("Time/" + entry + ": increments are those of " + list +
                         ", and it has no effect. Remove one of both, or "
                         "leave " +
                         entry + " at 1.");
      };
      const auto is = [&prm](const std::string &entry, const double value) {
        return prm.get(entry).empty() ||
               to_number(prm.get(entry), "Time/" + entry) == value;
      };
      if (!is("Increments", 1))
        refuse("Increments");
      if (!is("End", 1) && !is("End", end))
        refuse("End");
    }
  } // namespace

  void
  declare_time(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Anything;
    prm.declare_entry("End",
                      "1",
                      Anything(),
                      "Time at the end of the last increment; every history "
                      "starts at t = 0. Time only orders the loads. [time]");
    prm.declare_entry("Increments",
                      "1",
                      Anything(),
                      "Number of equal increments.");
    prm.declare_entry("Times",
                      "",
                      Anything(),
                      "The times at which increments end, in ascending order, "
                      "separated by commas. They replace End and Increments. "
                      "[time]");
    prm.declare_entry("Stages",
                      "",
                      Anything(),
                      "Stages of equal increments, each as 'end : "
                      "increments', separated by commas, such as 1 : 1, 11 : "
                      "20. They replace End and Increments. [time]");
  }

  std::vector<double>
  create_times(dealii::ParameterHandler &prm)
  {
    std::vector<double> times;
    const std::string   list = prm.get("Times"), stages = prm.get("Stages");
    if (!list.empty() && !stages.empty())
      throw InputError(
        "Time: both Times and Stages are given. Leave one empty.");
    for (const double end : to_numbers(list, "Time/Times"))
      append_stage(times, end, 1);
    for (const std::string &stage : split(stages, ','))
      {
        const std::vector<std::string> parts = split(stage, ':');
        if (parts.size() != 2)
          throw InputError("Time/Stages: '" + stage +
                           "' is not 'end : increments'. Commas stand between "
                           "stages, as in 1 : 2, 3 : 4.");
        append_stage(times,
                     to_number(parts[0], "Time/Stages"),
                     to_number(parts[1], "Time/Stages"));
      }
    if (!times.empty())
      refuse_idle(prm, list.empty() ? "Stages" : "Times", times.back());
    else
      append_stage(times,
                   to_number(prm.get("End"), "Time/End"),
                   to_number(prm.get("Increments"), "Time/Increments"));
    return times;
  }
} // namespace conetact::application
