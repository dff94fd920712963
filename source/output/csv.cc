// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/csv.h"

#include "conetact/base/errors.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

namespace conetact::output
{
  void
  append_number(std::string &text, const double number)
  {
    Assert(std::isfinite(number),
           dealii::ExcMessage("Tables have finite numbers only."));
    if (number == 0.) // most entries of a table; and no -0
      {
        text += '0';
        return;
      }
    std::array<char, 32> buffer;
    const auto           end = std::to_chars(buffer.data(),
                                   buffer.data() + buffer.size(),
                                   number,
                                   std::chars_format::general,
                                   15)
                       .ptr;
    text.append(buffer.data(), end);
  }



  const char *
  state_name(const solvers::NodeState state)
  {
    switch (state)
      {
        case solvers::NodeState::open:
          return "open";
        case solvers::NodeState::stick:
          return "stick";
        case solvers::NodeState::slip:
          return "slip";
      }
    return "";
  }



  std::string
  safe_name(const std::string &name)
  {
    const auto is_safe = [](const char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
             (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    };
    std::string safe = name;
    std::replace_if(
      safe.begin(), safe.end(), [&](const char c) { return !is_safe(c); }, '_');
    return safe;
  }



  std::vector<std::string>
  safe_names(const std::vector<std::string> &names)
  {
    std::vector<std::string> result;
    std::set<std::string>    taken;
    for (const std::string &name : names)
      {
        std::string safe = safe_name(name);
        for (unsigned int i = 2; !taken.insert(safe).second; ++i)
          safe = safe_name(name) + '_' + std::to_string(i);
        result.push_back(safe);
      }
    return result;
  }



  void
  NoiseFloor::see(const double value)
  {
    Assert(std::isfinite(value),
           dealii::ExcMessage("Tables have finite numbers only."));
    largest = std::max(largest, std::abs(value));
  }



  double
  NoiseFloor::clean(const double value) const
  {
    Assert(std::isfinite(value),
           dealii::ExcMessage("Tables have finite numbers only."));
    return std::abs(value) < 1e-14 * largest ? 0. : value;
  }



  NoiseFloor
  noise_of_forces(const model::IncrementRecord &record)
  {
    NoiseFloor floor;
    for (const model::ContactRow &row : record.rows)
      floor.see(row.reaction.norm());
    for_each_resultant(record, [&](const model::Resultant &resultant) {
      floor.see(resultant.force.norm());
    });
    return floor;
  }



  NoiseFloor
  noise_of_moments(const model::IncrementRecord &record)
  {
    NoiseFloor floor;
    for (const model::ContactRow &row : record.rows)
      floor.see(row.reaction.norm() * row.position.norm());
    for_each_resultant(record, [&](const model::Resultant &resultant) {
      floor.see(resultant.moment.norm());
    });
    return floor;
  }



  CsvRow::CsvRow(std::string &table, std::string place)
    : text(table)
    , where(std::move(place))
  {}



  void
  CsvRow::separate()
  {
    if (!first)
      text += ',';
    first = false;
  }



  void
  CsvRow::add(const char *column, const double value)
  {
    if (!std::isfinite(value))
      throw AnalysisError(where + ": the value of " + column +
                          " is not a finite number; this increment is not "
                          "written, all increments before it are.");
    separate();
    append_number(text, value);
  }



  void
  CsvRow::add(const unsigned int value)
  {
    separate();
    text += std::to_string(value);
  }



  void
  CsvRow::add(const std::string &value)
  {
    separate();
    text += value;
  }



  void
  CsvRow::end()
  {
    text += '\n';
  }
} // namespace conetact::output
