// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_json_text_h
#define conetact_application_json_text_h

#include <string>

namespace conetact::application
{
  /** In quotes, as JSON wants it. */
  std::string
  json_string(const std::string &text);
} // namespace conetact::application

#endif
