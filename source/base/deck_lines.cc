// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/deck_lines.h"

#include "conetact/base/file_mesh.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

namespace conetact
{
  namespace
  {
    std::string_view
    trimmed(std::string_view text)
    {
      const char *blanks = " \t\r\n";
      const auto  first  = text.find_first_not_of(blanks);
      if (first == text.npos)
        return {};
      return text.substr(first, text.find_last_not_of(blanks) - first + 1);
    }

    /** Without quotes and the blanks round it. */
    std::string
    plain(const std::string_view &text)
    {
      std::string_view value = trimmed(text);
      if (value.size() > 1 && value.front() == '"' && value.back() == '"')
        value = value.substr(1, value.size() - 2);
      return std::string(value);
    }

    std::string
    contents_of(const std::filesystem::path &path)
    {
      std::error_code error;
      if (!std::filesystem::is_regular_file(path, error))
        return "";
      std::ifstream      stream(path, std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      return text.str();
    }
  } // namespace

  std::string
  upper_case(const std::string_view &text)
  {
    std::string result = one_line(std::string(text));
    for (char &c : result)
      c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return trim(result);
  }

  std::string
  DeckBlock::value(const std::string &name) const
  {
    const auto found = parameters.find(name);
    return found == parameters.end() ? "" : found->second;
  }

  DeckText::DeckText(const std::string           &contents,
                     const std::filesystem::path &path)
  {
    texts.push_back(contents);
    paths.push_back(path);
    read(0);
  }

  void
  DeckText::fail(const DeckLine &line, const std::string &why) const
  {
    throw FileFault{
      (line.file == 0 ? "" : paths[line.file].filename().string() + ", ") +
      "line " + std::to_string(line.number) + ": " + why};
  }

  std::vector<std::string_view>
  DeckText::fields(const DeckLine &line)
  {
    std::vector<std::string_view> result;
    std::string_view              rest = line.text;
    while (!rest.empty())
      {
        const auto comma = rest.find(',');
        result.push_back(trimmed(rest.substr(0, comma)));
        rest = comma == rest.npos ? std::string_view() :
                                    trimmed(rest.substr(comma + 1));
      }
    return result;
  }

  /* A binary file is quoted as well. */
  std::string
  DeckText::quoted(const std::string_view &field)
  {
    std::string text(field.substr(0, 20));
    for (char &c : text)
      if (static_cast<unsigned char>(c) < 32 ||
          static_cast<unsigned char>(c) > 126)
        c = '?';
    return "'" + text + "'";
  }

  double
  DeckText::number(const std::string_view &field, const DeckLine &line) const
  {
    const auto value = fortran_number(std::string(field));
    if (!value)
      fail(line, quoted(field) + " stands there instead of a number");
    if (!std::isfinite(*value))
      fail(line, quoted(field) + " is not a finite number");
    return *value;
  }

  unsigned int
  DeckText::label(const std::string_view &field, const DeckLine &line) const
  {
    const double value = number(field, line);
    if (!(value >= 1 && value <= 4e9 && value == std::floor(value)))
      fail(line,
           quoted(field) +
             " stands there instead of the number of a node or element");
    return static_cast<unsigned int>(value);
  }

  void
  DeckText::read(const std::size_t file)
  {
    const std::string_view text    = texts[file];
    std::size_t            n_lines = 0;
    std::string            head; // which goes on behind a comma
    DeckLine               at{};
    for (std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const DeckLine    line{trimmed(text.substr(begin, end - begin)),
                            file,
                            ++n_lines};
        begin = end + 1;
        if (line.text.empty() || line.text.substr(0, 2) == "**")
          continue;
        const bool is_head = line.text.front() == '*' || !head.empty();
        if (!is_head && all.empty())
          fail(line, "a keyword such as *NODE must come first");
        if (!is_head)
          {
            all.back().lines.push_back(line);
            continue;
          }
        if (head.empty())
          at = line;
        head += std::string(line.text);
        if (line.text.back() == ',')
          continue;
        open_block(at, head);
        head.clear();
      }
    if (!head.empty())
      open_block(at, head);
  }

  void
  DeckText::open_block(const DeckLine &head, const std::string &text)
  {
    DeckBlock block;
    block.head       = head;
    const auto parts = split(text.substr(1), ',');
    block.keyword    = parts.empty() ? "" : upper_case(parts[0]);
    for (std::size_t i = 1; i < parts.size(); ++i)
      {
        const auto equals = parts[i].find('=');
        block.parameters[upper_case(parts[i].substr(0, equals))] =
          equals == std::string::npos ? "" : plain(parts[i].substr(equals + 1));
      }
    const bool has_file = block.keyword == "NODE" ||
                          block.keyword == "ELEMENT" ||
                          block.keyword == "NSET" || block.keyword == "ELSET";
    if (block.keyword != "INCLUDE")
      all.push_back(block);
    if (block.keyword == "INCLUDE" || (has_file && block.has("INPUT")))
      include(block);
  }

  void
  DeckText::include(const DeckBlock &block)
  {
    const std::string name = block.value("INPUT");
    if (name.empty())
      fail(block.head, "it names no file. Write *INCLUDE, INPUT=FILE");
    const auto path = paths[block.head.file].parent_path() / name;
    texts.push_back(contents_of(path));
    paths.push_back(path);
    if (texts.back().empty())
      fail(block.head,
           "the file '" + name +
             "' is not there, or empty. Put it beside the "
             "deck");
    if (++depth > 50)
      fail(block.head, "more than 50 files include each other");
    read(texts.size() - 1);
    --depth;
  }
} // namespace conetact
