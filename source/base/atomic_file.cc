// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/atomic_file.h"

#include "conetact/base/errors.h"
#include "conetact/base/new_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string>
#include <system_error>

namespace conetact
{
  namespace
  {
    namespace fs = std::filesystem;

    bool writes = true; // the files that processes have in common

    [[noreturn]] void
    fail(const fs::path &file)
    {
      fail_to_write(file, std::error_code(errno, std::generic_category()));
    }

    // POSIX calls, because streams hide why a write failed.
    void
    write_file(const fs::path &file, const std::string_view text, const int how)
    {
      const int   fd = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | how, 0666);
      struct stat before;
      if (fd < 0 || ::fstat(fd, &before) != 0)
        fail(file);
      for (std::string_view rest = text; !rest.empty();)
        {
          const ssize_t n = ::write(fd, rest.data(), rest.size());
          if (n < 0 && errno == EINTR)
            continue;
          if (n < 0)
            {
              const std::error_code error(errno, std::generic_category());
              // The error that is told is the first one.
              [[maybe_unused]] const int cut = ::ftruncate(fd, before.st_size);
              ::close(fd);
              fail_to_write(file, error);
            }
          rest.remove_prefix(static_cast<std::size_t>(n));
        }
      // Some file systems report a full disk only here.
      if (::close(fd) != 0)
        fail(file);
    }
  } // namespace



  void
  fail_to_write(const fs::path &file, const std::error_code &error)
  {
    const bool is_full =
      error == std::errc::no_space_on_device || error.value() == EDQUOT;
    const bool is_missing = error == std::errc::no_such_file_or_directory;
    throw WriteError(
      "Cannot write " + file.string() + " (" + error.message() + "): " +
      (is_full    ? "free some disk space or choose another folder" :
       is_missing ? "make its folder or choose another one" :
                    "choose another folder") +
      "; what was written before is intact.");
  }



  void
  append_to_file(const fs::path &file, const std::string_view text)
  {
    write_file(file, text, O_APPEND | O_NOFOLLOW);
  }



  void
  create_anew(const fs::path &file)
  {
    ::unlink(file.c_str()); // what cannot be removed is told by the next call
    write_file(file, "", O_CREAT | O_EXCL);
  }



  void
  take_size_limits_as_errors()
  {
    std::signal(SIGXFSZ, SIG_IGN);
  }



  void
  leave_files_to_first()
  {
    writes = false;
  }



  void
  write_atomically(const fs::path                              &file,
                   const std::function<void(const fs::path &)> &write)
  {
    if (writes)
      replace_file(file, write);
  }



  void
  replace_file(const fs::path                              &file,
               const std::function<void(const fs::path &)> &write)
  {
    const fs::path  temporary = file.string() + ".tmp";
    std::error_code error;
    create_anew(temporary);
    try
      {
        write(temporary);
        fs::rename(temporary, file, error);
        if (error)
          fail_to_write(file, error);
      }
    catch (...)
      {
        fs::remove(temporary, error);
        throw;
      }
  }



  void
  remove_file(const fs::path &file)
  {
    std::error_code ignored; // what cannot be removed stays
    if (writes)
      fs::remove(file, ignored);
  }



  void
  write_atomically(const fs::path &file, const std::string_view text)
  {
    write_atomically(file, [text](const fs::path &temporary) {
      append_to_file(temporary, text);
    });
  }
} // namespace conetact
