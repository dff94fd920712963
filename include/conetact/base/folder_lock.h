// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_folder_lock_h
#define conetact_base_folder_lock_h

#include <filesystem>

namespace conetact
{
  /**
   * While it lives no other run may write into a folder of results. The lock
   * lies on its log.txt, which every run has; the system takes it from a run
   * that ends, however it ends. Where a file system has no locks there are
   * none. Of many processes the first one locks for all.
   */
  class FolderLock
  {
  public:
    /** Throws WriteError if another run has the folder, with nothing changed,
     * or if there can be no log.txt. */
    explicit FolderLock(const std::filesystem::path &folder);
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;

    /** Throws WriteError if another run has the folder now. */
    static void
    check(const std::filesystem::path &folder);

  private:
    int fd = -1; ///< of log.txt
  };
} // namespace conetact

#endif
