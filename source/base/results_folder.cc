// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/results_folder.h"

#include "conetact/base/errors.h"
#include "conetact/base/folder_lock.h"
#include "conetact/base/process.h"

#include <unistd.h>

#include <string>
#include <system_error>

namespace conetact
{
  namespace
  {
    [[noreturn]] void
    refuse_folder(const std::filesystem::path &folder, const std::string &why)
    {
      throw WriteError("The folder " + folder.string() + " cannot be made: " +
                       why + ". Choose another one with -o.");
    }
  } // namespace



  void
  check_folder(const std::filesystem::path &folder)
  {
    if (!ProcessSession::speaks())
      return;
    std::error_code       error;
    std::filesystem::path existing = std::filesystem::absolute(folder, error);
    while (!error && !std::filesystem::exists(existing, error) && !error &&
           existing.has_relative_path())
      existing = existing.parent_path();
    if (error)
      refuse_folder(folder, error.message());
    if (!std::filesystem::is_directory(existing, error) ||
        access(existing.c_str(), W_OK | X_OK) != 0)
      refuse_folder(folder,
                    existing.string() +
                      " is not a folder that can be written to");
    FolderLock::check(folder);
  }



  void
  make_folder(const std::filesystem::path &folder)
  {
    if (!ProcessSession::speaks())
      return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder))
      refuse_folder(folder, error.message());
  }
} // namespace conetact
