// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_text_h
#define conetact_base_text_h

#include <deal.II/base/point.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace conetact
{
  /** Without white space at both ends. */
  std::string
  trim(const std::string &text);

  /**
   * Parts between separators that stand outside brackets, trimmed. Empty
   * parts are kept, an empty text has no part.
   */
  std::vector<std::string>
  split(const std::string &text, const char separator);

  /** Parts joined again: "a, b, c". */
  std::string
  join(const std::vector<std::string> &parts,
       const std::string              &separator = ", ");
  std::string
  join(const std::set<unsigned int> &numbers);

  /** Line breaks and runs of blanks become one blank. */
  std::string
  one_line(const std::string &text);

  std::string
  lower_case(std::string text);

  /** Of a file, in lower case and without its dot. */
  std::string
  extension_of(const std::filesystem::path &file);

  /** Shortest text that reads well: 6 significant digits. */
  std::string
  to_text(const double value);
  /** "(1, 2, 3)" */
  std::string
  to_text(const dealii::Tensor<1, 3> &vector);
} // namespace conetact

#endif
