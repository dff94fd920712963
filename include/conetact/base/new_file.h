// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_new_file_h
#define conetact_base_new_file_h

#include <filesystem>

namespace conetact
{
  /** An empty file of our own: what has its name, a link as well, is removed
   * and never written to. Throws WriteError. */
  void
  create_anew(const std::filesystem::path &file);
} // namespace conetact

#endif
