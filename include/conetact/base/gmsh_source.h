// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_gmsh_source_h
#define conetact_base_gmsh_source_h

#include "conetact/base/file_mesh.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

namespace conetact
{
  /** Words of a text, or numbers as they stand in memory. */
  class GmshSource
  {
  public:
    explicit GmshSource(const std::string &contents)
      : bytes(contents)
    {}

    bool is_binary = false;

    /** Goes behind the next "$Name" and its line; empty: there is none. */
    std::string
    next_section()
    {
      while (at < bytes.size())
        if (const std::string text = line(); !text.empty() && text[0] == '$')
          {
            section = text.substr(1);
            return section;
          }
      return "";
    }
    /** Goes behind the end of the section. */
    void
    leave_section()
    {
      const std::string end   = "$End" + section;
      const std::size_t found = bytes.find(end, at);
      if (found == std::string::npos)
        ends_early();
      at = found + end.size();
    }

    std::string
    word()
    {
      while (at < bytes.size() && is_blank(bytes[at]))
        ++at;
      const std::size_t begin = at;
      while (at < bytes.size() && !is_blank(bytes[at]))
        ++at;
      if (begin == at || bytes[begin] == '$')
        ends_early();
      return bytes.substr(begin, at - begin);
    }
    /** The rest of the line, trimmed. */
    std::string
    line()
    {
      const std::size_t begin = at;
      const std::size_t end   = std::min(bytes.find('\n', begin), bytes.size());
      at                      = std::min(end + 1, bytes.size());
      return trim(bytes.substr(begin, end - begin));
    }
    double
    real()
    {
      return is_binary ? take<double>() : number();
    }
    /** An integer that may be below 0, 4 bytes. */
    long
    integer()
    {
      return is_binary ? take<std::int32_t>() : whole();
    }
    /** A number of things or a number of one of them, 8 bytes. */
    std::size_t
    count()
    {
      const std::size_t value =
        is_binary ? take<std::uint64_t>() : from_zero(whole());
      if (value > 4000000000u)
        throw FileFault{"it holds numbers that are too large"};
      return value;
    }
    /** The same with 4 bytes. */
    std::size_t
    small_count()
    {
      return from_zero(integer());
    }
    Point<3>
    point()
    {
      Point<3> p;
      for (unsigned int d = 0; d < 3; ++d)
        p[d] = real();
      if (!std::isfinite(p.norm_square()))
        throw FileFault{"a coordinate of " + to_text(p) +
                        " is not a finite number"};
      return p;
    }
    /** "line 7: ", of what was read last. */
    std::string
    place() const
    {
      const auto end =
        bytes.begin() + static_cast<std::ptrdiff_t>(at > 0 ? at - 1 : 0);
      return "line " +
             std::to_string(1 + std::count(bytes.begin(), end, '\n')) + ": ";
    }
    [[noreturn]] void
    ends_early() const
    {
      throw FileFault{"its section '" + section + "' does not end"};
    }

  private:
    static bool
    is_blank(const char c)
    {
      return c == ' ' || c == '\n' || c == '\r' || c == '\t';
    }
    template <class Number>
    Number
    take()
    {
      if (bytes.size() - at < sizeof(Number))
        ends_early();
      Number value;
      std::memcpy(&value, &bytes[at], sizeof(Number));
      at += sizeof(Number);
      return value;
    }
    double
    number()
    {
      const std::string text  = word();
      char             *end   = nullptr;
      const double      value = std::strtod(text.c_str(), &end);
      if (end != text.c_str() + text.size())
        throw FileFault{"'" + text.substr(0, 20) +
                        "' stands there instead of a number"};
      return value;
    }
    long
    whole()
    {
      const double value = number();
      if (!(std::abs(value) <= 4e9 && value == std::floor(value)))
        throw FileFault{to_text(value) +
                        " stands there instead of a whole number"};
      return static_cast<long>(value);
    }
    static std::size_t
    from_zero(const long value)
    {
      if (value < 0)
        throw FileFault{std::to_string(value) +
                        " stands there instead of a number from 0 on"};
      return static_cast<std::size_t>(value);
    }

    const std::string &bytes;
    std::size_t        at = 0;
    std::string        section;
  };
} // namespace conetact

#endif
