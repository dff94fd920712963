// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_atomic_file_h
#define conetact_base_atomic_file_h

#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

namespace conetact
{
  /**
   * A file that reaches the largest size that is allowed (ulimit -f) is an
   * error to be told, and no longer a signal that ends the process at once and
   * leaves temporary files behind. To be called when a program starts.
   */
  void
  take_size_limits_as_errors();

  /** From now on write_atomically() and remove_file() do nothing: of many
   * processes the first one writes what they have in common. */
  void
  leave_files_to_first();

  /** Throws a WriteError that says so of this file. */
  [[noreturn]] void
  fail_to_write(const std::filesystem::path &file,
                const std::error_code       &error);

  /** Adds whole lines to a file that is there, by one call of the system.
   * Throws WriteError, with the file as it was; only a kill in between can
   * leave a part of a line at its end. */
  void
  append_to_file(const std::filesystem::path &file,
                 const std::string_view       text);

  /**
   * Replaces a file by `text`: written under a temporary name in the same
   * folder, closed, renamed. Whoever looks sees the old file or the new one,
   * never a part, even after a kill or on a full disk. Throws WriteError, with
   * the old file intact and the temporary one removed. Of many processes the
   * first one writes, others do nothing.
   */
  void
  write_atomically(const std::filesystem::path &file,
                   const std::string_view       text);

  /** The same for a writer that opens the file itself, under the name given. */
  void
  write_atomically(
    const std::filesystem::path                              &file,
    const std::function<void(const std::filesystem::path &)> &write);

  /** The same by any process: a file of its own. */
  void
  replace_file(const std::filesystem::path                              &file,
               const std::function<void(const std::filesystem::path &)> &write);

  /** Removes a file that may be there; of many processes the first one does. */
  void
  remove_file(const std::filesystem::path &file);
} // namespace conetact

#endif
