// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/interruption.h"

#include <unistd.h>

#include <cstdlib>
#include <ctime>

namespace conetact
{
  namespace
  {
    volatile std::sig_atomic_t is_interrupted = 0;
    timespec                   when           = {}; ///< before that is set

    double
    seconds(const timespec &t)
    {
      return static_cast<double>(t.tv_sec) +
             1e-9 * static_cast<double>(t.tv_nsec);
    }

    constexpr char told[] =
      "\nconetact: The increment that is running is finished first, unless it "
      "is hard to find; Ctrl-C once more ends the run at once.\n";

    /** Nothing but what a handler may call. */
    void
    take_interrupt(int)
    {
      ::clock_gettime(CLOCK_MONOTONIC, &when);
      is_interrupted = 1;
      if (::write(STDERR_FILENO, told, sizeof(told) - 1) < 0)
        return; // nobody listens
    }
  } // namespace



  Interruption::Interruption()
    : before()
  {
    is_interrupted       = 0;
    struct sigaction now = {};
    now.sa_handler       = take_interrupt;
    now.sa_flags         = SA_RESTART | SA_RESETHAND;
    sigemptyset(&now.sa_mask);
    sigaction(SIGINT, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
      sigaction(SIGINT, &now, nullptr);
  }



  Interruption::~Interruption()
  {
    sigaction(SIGINT, &before, nullptr);
  }



  bool
  Interruption::is_wanted()
  {
    return is_interrupted != 0;
  }



  bool
  Interruption::is_urgent()
  {
    constexpr double patience = 1; // [s]
    timespec         now      = {};
    if (!is_wanted())
      return false;
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return seconds(now) - seconds(when) > patience;
  }



  void
  Interruption::stop(const std::string &why)
  {
    is_interrupted = 0; // other runs of a batch may follow
    throw Interrupted(why);
  }



  void
  Interruption::end_process()
  {
    struct sigaction usual = {};
    usual.sa_handler       = SIG_DFL;
    sigemptyset(&usual.sa_mask);
    sigaction(SIGINT, &usual, nullptr);
    raise(SIGINT);
    std::_Exit(Interrupted::exit_code);
  }
} // namespace conetact
