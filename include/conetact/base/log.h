// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_log_h
#define conetact_base_log_h

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

namespace conetact
{
  /**
   * What a run did, for people: lines go to log.txt (kept until its folder is
   * known) and, unless quiet, the more important ones to standard output. Of
   * many processes the first one has a log, those of the others are silent.
   */
  class Log
  {
  public:
    /** `verbose`: notes go to standard output too. */
    Log(const bool quiet, const bool verbose);

    /** log.txt only. */
    void
    note(const std::string &line);
    /** log.txt and standard output; a warning begins with "warning: ". */
    void
    say(const std::string &line);
    /** Warnings said so far. */
    unsigned int
    n_warnings() const
    {
      return warnings;
    }
    /** A note with the seconds since the last time() or the start. */
    void
    time(const std::string &what);

    /**
     * From now on lines go to FOLDER/log.txt, behind those that are there if
     * the run goes on. Throws WriteError.
     */
    void
    open(const std::filesystem::path &folder, const bool goes_on = false);

  private:
    void
    keep(const std::string &line);

    using Clock = std::chrono::steady_clock;
    const bool        silent, quiet, verbose;
    Clock::time_point last;
    unsigned int      warnings = 0;
    std::string       kept;
    std::ofstream     file;
  };

  /** What was asked for, to standard output; of many processes the first one
   * does so. Throws WriteError. */
  void
  print(const std::string &text);
} // namespace conetact

#endif
