// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/value_kind.h"

#include "conetact/base/text.h"

namespace conetact::application
{
  namespace
  {
    /** "0...1 (inclusive)" */
    void
    take_range(std::string text, ValueKind &kind)
    {
      text            = text.substr(0, text.find(" (inclusive)"));
      const auto dots = text.find("...");
      if (dots == text.npos)
        return;
      kind.least = text.substr(0, dots);
      kind.most  = text.substr(dots + 3);
      if (kind.most == "2147483647" || kind.most == "MAX_DOUBLE")
        kind.most.clear();
      if (kind.least == "-2147483648" || kind.least == "-MAX_DOUBLE")
        kind.least.clear();
    }
  } // namespace



  ValueKind
  value_kind(std::string pattern)
  {
    using Type = ValueKind::Type;
    pattern    = trim(pattern);
    if (pattern.size() > 1 && pattern.front() == '[' && pattern.back() == ']')
      pattern = trim(pattern.substr(1, pattern.size() - 2));
    ValueKind  kind;
    const auto is = [&](const std::string &start, const Type type) {
      if (pattern.rfind(start, 0) != 0)
        return false;
      kind.type = type;
      pattern   = trim(pattern.substr(start.size()));
      return true;
    };
    if (is("Selection", Type::word))
      kind.words = split(pattern, '|');
    else if (is("Integer range", Type::integer) || is("Double", Type::number) ||
             is("Integer", Type::integer))
      take_range(pattern, kind);
    else
      is("Bool", Type::boolean);
    return kind;
  }
} // namespace conetact::application
