// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/folder_lock.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/process.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace conetact
{
  namespace
  {
    /** What a link leads to is not ours. */
    int
    open_log(const std::filesystem::path &folder, const int how)
    {
      return ::open((folder / "log.txt").c_str(),
                    O_RDWR | O_NOFOLLOW | O_CLOEXEC | how,
                    0666);
    }

    void
    refuse_if_held(const int fd, const std::filesystem::path &folder)
    {
      if (::flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
        return;
      ::close(fd);
      throw WriteError("Another run writes into the folder " + folder.string() +
                       " now. Wait until it has ended, or choose another "
                       "folder with -o.");
    }
  } // namespace



  FolderLock::FolderLock(const std::filesystem::path &folder)
  {
    if (!ProcessSession::speaks())
      return;
    fd = open_log(folder, O_CREAT);
    if (fd < 0)
      fail_to_write(folder / "log.txt",
                    std::error_code(errno, std::generic_category()));
    refuse_if_held(fd, folder);
  }



  FolderLock::~FolderLock()
  {
    if (fd >= 0)
      ::close(fd);
  }



  void
  FolderLock::check(const std::filesystem::path &folder)
  {
    const int log = ProcessSession::speaks() ? open_log(folder, 0) : -1;
    if (log < 0)
      return;
    refuse_if_held(log, folder);
    ::close(log);
  }
} // namespace conetact
