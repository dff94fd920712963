// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/log.h"

#include "conetact/base/errors.h"
#include "conetact/base/process.h"

#include <cerrno>
#include <cstdio>
#include <iostream>

namespace conetact
{
  Log::Log(const bool q, const bool v)
    : silent(!ProcessSession::speaks())
    , quiet(q || silent)
    , verbose(v)
    , last(Clock::now())
  {}

  void
  Log::note(const std::string &line)
  {
    keep(line);
    if (verbose && !quiet)
      std::cout << line << std::endl;
  }

  void
  Log::keep(const std::string &line)
  {
    if (silent)
      return;
    if (!file.is_open())
      kept += line + "\n";
    else if (!(file << line << std::endl))
      throw WriteError("log.txt cannot be written: is the disk full?");
  }

  void
  Log::say(const std::string &line)
  {
    keep(line);
    warnings += line.rfind("warning: ", 0) == 0;
    if (!quiet)
      std::cout << line << std::endl;
  }

  void
  Log::time(const std::string &what)
  {
    const Clock::time_point             now     = Clock::now();
    const std::chrono::duration<double> seconds = now - last;
    last                                        = now;
    char text[40];
    std::snprintf(text, sizeof(text), "%10.4f s  ", seconds.count());
    keep(text + what);
  }

  void
  Log::open(const std::filesystem::path &folder, const bool goes_on)
  {
    if (silent)
      return;
    file.open(folder / "log.txt", goes_on ? std::ios::app : std::ios::out);
    if (!(file << kept << std::flush))
      throw WriteError("The folder " + folder.string() +
                       " cannot be written: check its permissions and the "
                       "space on the disk.");
    kept.clear();
  }

  void
  print(const std::string &text)
  {
    errno = 0;
    if (!ProcessSession::speaks() || std::cout << text << std::flush)
      return;
    if (errno != EPIPE) // whoever reads has enough, as `head` does
      throw WriteError("Standard output cannot be written: is the disk full?");
  }
} // namespace conetact
