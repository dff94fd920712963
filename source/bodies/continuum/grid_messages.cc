// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/grid_messages.h"

#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <sstream>

namespace conetact::bodies
{
  namespace
  {
    void
    erase_all(std::string &text, const std::string &part)
    {
      for (auto at = text.find(part); at != std::string::npos;
           at      = text.find(part))
        text.erase(at, part.size());
    }
  } // namespace



  std::string
  cell_name(const unsigned int dim, const bool simplices)
  {
    if (simplices)
      return dim == 2 ? "triangles" : "tetrahedra";
    return dim == 2 ? "quadrilaterals" : "hexahedra";
  }



  std::string
  message_of(const std::exception &error)
  {
    const auto *deal = dynamic_cast<const dealii::ExceptionBase *>(&error);
    if (deal == nullptr)
      return one_line(error.what());
    if (dynamic_cast<const dealii::ExcIO *>(deal) != nullptr)
      return "it ends early, or holds something else";
    std::ostringstream text;
    deal->print_info(text);
    std::string message = one_line(text.str());
    for (const char *bounds : {" -MAX_DOUBLE...MAX_DOUBLE (inclusive)",
                               " of length 0...4294967295 (inclusive)"})
      erase_all(message, bounds);
    for (char &c : message) // a binary file is quoted as it is
      if (static_cast<unsigned char>(c) < 32 ||
          static_cast<unsigned char>(c) > 126)
        c = '?';
    return message.size() > 300 ? message.substr(0, 300) + "..." : message;
  }
} // namespace conetact::bodies
