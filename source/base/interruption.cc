// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/interruption.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
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

    /** Sentences of which a handler may write the last one, whenever it is
     * called: the other one is changed. */
    struct Sentence
    {
      std::array<char, 2048> text   = {};
      std::size_t            length = 0;
    };
    std::array<Sentence, 2>       sentences;
    std::atomic<const Sentence *> last_sentence = nullptr;

    /** Nothing but what a handler may call. */
    void
    take_interrupt(int)
    {
      ::clock_gettime(CLOCK_MONOTONIC, &when);
      is_interrupted = 1;
      if (::write(STDERR_FILENO, told, sizeof(told) - 1) < 0)
        return; // nobody listens
    }

    /** mpirun leaves its processes a second. */
    void
    take_end(const int signal)
    {
      const Sentence *const known = last_sentence;
      if (known != nullptr &&
          ::write(STDERR_FILENO, known->text.data(), known->length) < 0)
        return; // nobody listens, and SIGKILL follows
      raise(signal);
    }

    void
    set_handler(const int signal,
                void (*const handler)(int),
                struct sigaction &before)
    {
      struct sigaction now = {};
      now.sa_handler       = handler;
      now.sa_flags         = SA_RESTART | SA_RESETHAND;
      sigemptyset(&now.sa_mask);
      sigaction(signal, nullptr, &before);
      if (before.sa_handler != SIG_IGN)
        sigaction(signal, &now, nullptr);
    }
  } // namespace



  Interruption::Interruption(const bool is_alone)
    : wish(is_alone ? SIGINT : forwarded)
    , before_wish()
    , before_end()
  {
    is_interrupted = 0;
    last_sentence  = nullptr;
    set_handler(wish, take_interrupt, before_wish);
    if (ends_at_once())
      set_handler(SIGTERM, take_end, before_end);
  }



  Interruption::~Interruption()
  {
    sigaction(wish, &before_wish, nullptr);
    if (ends_at_once())
      sigaction(SIGTERM, &before_end, nullptr);
  }



  bool
  Interruption::ends_at_once() const
  {
    return wish != SIGINT;
  }



  void
  Interruption::know(const std::string &what)
  {
    Sentence &next =
      last_sentence == &sentences[0] ? sentences[1] : sentences[0];
    const std::string line = "\nconetact: " + what + "\n";
    next.length            = std::min(line.size(), next.text.size());
    std::copy_n(line.begin(), next.length, next.text.begin());
    last_sentence = &next;
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
