// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_value_kind_h
#define conetact_application_value_kind_h

#include <string>
#include <vector>

namespace conetact::application
{
  /** What an entry may be set to. */
  struct ValueKind
  {
    enum class Type
    {
      text, ///< whatever the entry's documentation says
      word, ///< one of a few
      integer,
      number,
      boolean
    };
    Type                     type = Type::text;
    std::vector<std::string> words;
    std::string              least, most; ///< of numbers; empty: no limit
  };

  /** From what deal.II calls a pattern, "[Double 0...1 (inclusive)]". */
  ValueKind
  value_kind(std::string pattern);
} // namespace conetact::application

#endif
