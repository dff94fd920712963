// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_located_h
#define conetact_application_located_h

#include "conetact/application/command_line.h"

#include <string>

namespace conetact::application
{
  /**
   * A sentence about an entry, "Body 'block', Material/Poisson ratio: ...",
   * behind the file and the line where that entry stands, or the option -s that
   * replaced it, or the subsection that lacks it. Sentences about anything else
   * stay as they are.
   */
  std::string
  located(const std::string &sentence, const CommandLine &line);
} // namespace conetact::application

#endif
