// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/json_text.h"

#include <cstdio>

namespace conetact::application
{
  std::string
  json_string(const std::string &text)
  {
    std::string quoted = "\"";
    for (const char letter : text)
      if (letter == '"' || letter == '\\')
        quoted += std::string("\\") + letter;
      else if (static_cast<unsigned char>(letter) < ' ')
        {
          char code[8];
          std::snprintf(code, sizeof(code), "\\u%04x", letter);
          quoted += code;
        }
      else
        quoted += letter;
    return quoted + '"';
  }
} // namespace conetact::application
