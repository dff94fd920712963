// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_option_table_h
#define conetact_application_option_table_h

#include <string>
#include <vector>

namespace conetact::application
{
  /** An option of the command line. */
  struct OptionRow
  {
    /** What may stand behind it, for the completion of shells. */
    enum class Value
    {
      none,
      folder,
      file,
      entry, ///< of the scene, Section/Entry=value
      word,  ///< one of a few
      free
    };

    char                     letter;   ///< by which the program knows it
    bool                     is_short; ///< also as -LETTER
    const char              *name;
    Value                    value;
    const char              *value_name; ///< in the help
    std::vector<std::string> words; ///< that may be its value, of Value::word
    const char              *help;  ///< lines
  };

  /** In the order of the help. */
  const std::vector<OptionRow> &
  option_table();

  /** "  -o, --output FOLDER  write there ...", a row or more for each. */
  std::string
  help_on_options();
} // namespace conetact::application

#endif
