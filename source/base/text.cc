// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/text.h"

#include <cctype>
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
  lower_case(std::string text)
  {
    for (char &c : text)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  }

  std::string
  extension_of(const std::filesystem::path &file)
  {
    const std::string extension = lower_case(file.extension().string());
    return extension.empty() ? extension : extension.substr(1);
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
} // namespace conetact
