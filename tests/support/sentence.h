// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_sentence_h
#define conetact_tests_sentence_h

#include "conetact/base/errors.h"

#include <string>

namespace conetact::test
{
  /** The sentence that a call is refused with; "accepted" if it is not. */
  template <typename Error = InputError, typename Call>
  std::string
  sentence_of(const Call &call)
  {
    try
      {
        call();
      }
    catch (const Error &error)
      {
        return error.what();
      }
    return "accepted";
  }

  inline bool
  starts(const std::string &text, const std::string &with)
  {
    return text.rfind(with, 0) == 0;
  }
} // namespace conetact::test

#endif
