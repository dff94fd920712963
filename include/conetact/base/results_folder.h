// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_results_folder_h
#define conetact_base_results_folder_h

#include <filesystem>

namespace conetact
{
  // Of many processes the first one does this for all.

  /** Finds out early, and without writing, that a folder cannot be made or is
   * in use. Throws WriteError. */
  void
  check_folder(const std::filesystem::path &folder);

  /** With all folders around it. Throws WriteError. */
  void
  make_folder(const std::filesystem::path &folder);
} // namespace conetact

#endif
