// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_entry_texts_h
#define conetact_application_entry_texts_h

#include "conetact/application/command_line.h"

#include <string>

namespace conetact::application
{
  /**
   * What is made of all entries for shells and editors, and printed: the one
   * that the command line names. Throws InputError.
   */
  std::string
  entry_text(const CommandLine &line);

  /** A script that completes command lines in bash. */
  std::string
  bash_completion();

  /** Scene files in colours: a syntax file of vim. */
  std::string
  vim_syntax();

  /** The same for VS Code and others that read grammars of TextMate. */
  std::string
  textmate_grammar();

  /** All entries as a JSON schema of an object with an object for each
   * subsection. */
  std::string
  json_schema();
} // namespace conetact::application

#endif
