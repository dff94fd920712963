// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/text.h"

#include "conetact/base/errors.h"
#include "conetact/base/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace conetact
{
  std::string
  trim(const std::string &text)
  {
    const char *const blanks = " \t\r\n";
    const auto        begin  = text.find_first_not_of(blanks);
    if (begin == std::string::npos)
      return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
  }

  std::vector<std::string>
  split(const std::string &text, const char separator)
  {
    if (trim(text).empty())
      return {};
    std::vector<std::string> parts(1);
    int                      depth = 0;
    for (const char c : text)
      {
        depth += (c == '(') - (c == ')');
        if (c == separator && depth == 0)
          parts.emplace_back();
        else
          parts.back() += c;
      }
    for (std::string &part : parts)
      part = trim(part);
    return parts;
  }

  std::string
  join(const std::vector<std::string> &parts, const std::string &separator)
  {
    std::string text;
    for (const std::string &part : parts)
      text += (text.empty() ? "" : separator) + part;
    return text;
  }

  std::string
  join(const std::set<unsigned int> &numbers)
  {
    std::vector<std::string> parts;
    for (const unsigned int number : numbers)
      parts.push_back(std::to_string(number));
    return join(parts);
  }

  std::string
  one_line(const std::string &text)
  {
    std::string line;
    for (const char c : trim(text))
      {
        const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (!blank)
          line += c;
        else if (line.back() != ' ')
          line += ' ';
      }
    return line;
  }

  std::string
  to_text(const double value)
  {
    std::ostringstream stream;
    stream << (value == 0 ? 0. : value);
    return stream.str();
  }

  std::string
  to_text(const dealii::Tensor<1, 3> &vector)
  {
    return "(" + to_text(vector[0]) + ", " + to_text(vector[1]) + ", " +
           to_text(vector[2]) + ")";
  }

  double
  to_number(const std::string &text, const std::string &entry)
  {
    if (trim(text).empty())
      throw InputError(entry + ": a number is missing. Give one.");
    if (std::isnan(std::strtod(text.c_str(), nullptr)) ||
        std::isinf(std::strtod(text.c_str(), nullptr)))
      throw InputError(entry + ": '" + trim(text) +
                       "' is not a finite number. Give one.");
    const Expression expression(text, entry);
    if (!expression.is_constant())
      throw InputError(entry + ": '" + trim(text) +
                       "' depends on position or time. Give a number.");
    const double number = expression(dealii::Point<3>());
    if (!std::isfinite(number))
      throw InputError(entry + ": '" + trim(text) +
                       "' is not a finite number. Give one.");
    return number;
  }

  std::vector<double>
  to_numbers(const std::string &text, const std::string &entry)
  {
    std::vector<double> numbers;
    for (const std::string &part : split(text, ','))
      numbers.push_back(to_number(part, entry));
    return numbers;
  }

  dealii::Tensor<1, 3>
  to_vector(const std::string &text,
            const unsigned int dim,
            const std::string &entry)
  {
    std::string inner = trim(text);
    if (inner.size() > 1 && inner.front() == '(' && inner.back() == ')' &&
        split(inner, ',').size() == 1)
      inner = inner.substr(1, inner.size() - 2);
    const std::vector<double> numbers = to_numbers(inner, entry);
    if (numbers.empty())
      throw InputError(entry + " is empty. Give " + std::to_string(dim) +
                       " numbers, separated by commas.");
    if (numbers.size() != dim)
      throw InputError(entry + ": '" + trim(text) + "' has " +
                       std::to_string(numbers.size()) + " components. Give " +
                       std::to_string(dim) + " numbers, separated by commas.");
    dealii::Tensor<1, 3> vector;
    for (unsigned int d = 0; d < dim; ++d)
      vector[d] = numbers[d];
    return vector;
  }

  std::set<unsigned int>
  to_ids(const std::string &text, const std::string &entry)
  {
    std::set<unsigned int> ids;
    for (const std::string &part : split(text, ','))
      {
        const bool digits =
          !part.empty() && part.size() < 10 &&
          std::all_of(part.begin(), part.end(), [](const unsigned char c) {
            return std::isdigit(c) != 0;
          });
        if (!digits)
          throw InputError(entry + ": '" + part +
                           "' is not a boundary id. Give whole numbers, " +
                           "separated by commas.");
        ids.insert(static_cast<unsigned int>(std::stoul(part)));
      }
    if (ids.empty())
      throw InputError(entry + " is empty. Give at least one boundary id.");
    return ids;
  }
} // namespace conetact
