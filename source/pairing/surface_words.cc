// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/surface_words.h"

#include <cstdlib>

namespace conetact::pairing
{
  double
  read_number(std::istream &stream)
  {
    std::string word;
    if (!(stream >> word))
      throw Fault{"it ends in the middle"};
    char        *end   = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end != word.c_str() + word.size())
      throw Fault{"'" + word.substr(0, 20) +
                  "' stands there instead of a number"};
    return value;
  }

  Point<3>
  read_point(std::istream &stream)
  {
    Point<3> p;
    for (unsigned int d = 0; d < 3; ++d)
      p[d] = read_number(stream);
    return p;
  }
} // namespace conetact::pairing
