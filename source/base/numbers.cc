// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/numbers.h"

#include "conetact/base/errors.h"
#include "conetact/base/expression.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <regex>

namespace conetact
{
  namespace
  {
    /** Numbers as people write them elsewhere, with what is meant. */
    void
    refuse_what_is_no_number(const std::string &text, const std::string &entry)
    {
      constexpr std::size_t most_letters = 80; // an expression may have more
      char                 *end          = nullptr;
      std::strtod(text.c_str(), &end);
      if (end == text.c_str() + text.size() || text.size() > most_letters)
        return;
      static const std::string number = "([+-]?[0-9.]+([eE][+-]?[0-9]+)?)";
      static const std::regex  comma("([+-]?[0-9]+),([0-9]+)");
      static const std::regex  unit(number + "\\s*(%|[A-Za-z][A-Za-z/^0-9*]*)");
      static const std::regex  blank("([+-]?[0-9.]+)\\s+([eE][+-]?[0-9]+)");
      static const std::regex  exponent("[eE]([0-9].*)?");
      std::smatch              parts;
      const std::string        start = entry + ": '" + text + "' ";
      if (std::regex_match(text, parts, comma))
        throw InputError(start + "has a comma. Decimals have a point: " +
                         parts[1].str() + "." + parts[2].str() + ".");
      if (std::regex_match(text, parts, blank))
        throw InputError(start + "has a blank in it. Write " + parts[1].str() +
                         parts[2].str() + ".");
      if (std::regex_match(text, parts, unit) &&
          !std::regex_match(parts[3].str(), exponent))
        throw InputError(start + "has '" + parts[3].str() +
                         "' behind the number. Leave it out: units are yours, "
                         "any consistent ones.");
    }
  } // namespace

  double
  to_number(const std::string &text, const std::string &entry)
  {
    if (trim(text).empty())
      throw InputError(entry + ": a number is missing. Give one.");
    if (std::isnan(std::strtod(text.c_str(), nullptr)) ||
        std::isinf(std::strtod(text.c_str(), nullptr)))
      throw InputError(entry + ": '" + trim(text) +
                       "' is not a finite number. Give one.");
    refuse_what_is_no_number(trim(text), entry);
    const Expression expression(text, entry);
    if (!expression.is_constant())
      throw InputError(entry + ": '" + trim(text) +
                       "' depends on position or time. Give a number, not an "
                       "expression of them.");
    const double number = expression(dealii::Point<3>());
    if (!std::isfinite(number))
      throw InputError(entry + ": '" + trim(text) +
                       "' is not a finite number. Give one.");
    return number;
  }

  std::optional<double>
  fortran_number(std::string word)
  {
    for (char &c : word)
      if (c == 'D' || c == 'd')
        c = 'e';
    char        *end   = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end != word.c_str() + word.size())
      return {};
    return value;
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
    if (text.find(';') != text.npos)
      throw InputError(entry + ": '" + trim(text) +
                       "' has a ';'. Separate components by commas here.");
    std::string inner = trim(text);
    if (inner.size() > 1 && inner.front() == '(' && inner.back() == ')' &&
        split(inner, ',').size() == 1)
      inner = inner.substr(1, inner.size() - 2);
    const std::size_t n = split(inner, ',').size();
    const std::string wish =
      "Give " + std::to_string(dim) + " numbers, separated by commas.";
    if (n == 0)
      throw InputError(entry + " is empty. " + wish);
    if (n != dim)
      throw InputError(entry + ": '" + trim(text) + "' has " +
                       std::to_string(n) + " component" +
                       (n > 1 ? "s. " : ". ") + wish);
    const std::vector<double> numbers = to_numbers(inner, entry);
    dealii::Tensor<1, 3>      vector;
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
