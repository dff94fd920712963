// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_growing_file_h
#define conetact_base_growing_file_h

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace conetact
{
  /**
   * A file that grows by whole pieces, as whoever looks sees it: before, after
   * a kill, or on a full disk it ends with a piece. There are two of it. What
   * is added goes to the one under a temporary name, which then changes places
   * with the other, so that each piece is written twice, however long the file
   * is. (Where names cannot change places, as on some network disks, the file
   * is copied each time.)
   */
  class GrowingFile
  {
  public:
    /** Of a file that is there; what is smaller is copied each time, so that
     * nothing lies beside it. */
    explicit GrowingFile(std::filesystem::path existing,
                         const std::uint64_t   smaller = 1 << 20);
    /** Removes what has the temporary name. */
    ~GrowingFile();
    GrowingFile(const GrowingFile &) = delete;
    GrowingFile &
    operator=(const GrowingFile &) = delete;

    /** Adds a piece that publish() will show; once in between. Throws
     * WriteError, with the file as it was. */
    void
    add(const std::string_view piece);
    void
    publish();
    /** Removes what has the temporary name, until more is added. */
    void
    clear();

    /** Written so far. */
    std::uint64_t
    n_bytes() const
    {
      return bytes;
    }

  private:
    /** Whether the temporary one is as it was left. */
    bool
    has_other() const;

    const std::filesystem::path file, temporary;
    const std::uint64_t         small;
    std::string                 missing; ///< there, of what is published
    std::string                 added;
    std::uint64_t               size = 0, inode = 0; ///< of the temporary one
    std::uint64_t               bytes = 0;
  };
} // namespace conetact

#endif
