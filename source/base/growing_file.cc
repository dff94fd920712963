// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/growing_file.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/new_file.h"

#include <deal.II/base/exceptions.h>

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>

#include <utility>

namespace conetact
{
  namespace fs = std::filesystem;

  GrowingFile::GrowingFile(fs::path existing, const std::uint64_t smaller)
    : file(std::move(existing))
    , temporary(file.string() + ".tmp")
    , small(smaller)
  {}

  GrowingFile::~GrowingFile()
  {
    clear();
  }

  void
  GrowingFile::clear()
  {
    std::error_code none;
    fs::remove(temporary, none);
    size = 0;
  }

  bool
  GrowingFile::has_other() const
  {
    struct stat found;
    return size > 0 && ::lstat(temporary.c_str(), &found) == 0 &&
           found.st_ino == inode &&
           static_cast<std::uint64_t>(found.st_size) == size;
  }

  /* It lacks the last piece. */
  void
  GrowingFile::add(const std::string_view piece)
  {
    std::error_code error;
    added = piece;
    if (has_other())
      missing += piece;
    else
      {
        size = fs::file_size(file, error);
        if (error)
          fail_to_write(file, error);
        create_anew(temporary);
        fs::copy_file(file,
                      temporary,
                      fs::copy_options::overwrite_existing,
                      error);
        if (error)
          fail_to_write(file, error);
        bytes += size;
        missing = piece;
      }
    append_to_file(temporary, missing);
    size += missing.size();
    bytes += missing.size();
  }

  void
  GrowingFile::publish()
  {
    struct stat now;
    if (::lstat(file.c_str(), &now) == 0 && ::renameat2(AT_FDCWD,
                                                        temporary.c_str(),
                                                        AT_FDCWD,
                                                        file.c_str(),
                                                        RENAME_EXCHANGE) == 0)
      {
        size    = static_cast<std::uint64_t>(now.st_size);
        inode   = now.st_ino;
        missing = std::move(added);
        if (size < small)
          clear();
        return;
      }
    std::error_code error;
    fs::rename(temporary, file, error);
    if (error)
      fail_to_write(file, error);
    size = 0;
  }
} // namespace conetact
