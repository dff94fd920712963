// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_interruption_h
#define conetact_base_interruption_h

#include <csignal>
#include <stdexcept>
#include <string>

namespace conetact
{
  /** A run that was asked to stop has stopped: what is on disk, and how to go
   * on. Ends by SIGINT, which shells call exit code 130. */
  struct Interrupted : std::runtime_error
  {
    using std::runtime_error::runtime_error;
    static constexpr int exit_code = 128 + SIGINT;
  };

  /**
   * While it lives, a first SIGINT (Ctrl-C) is a wish, to be asked for where
   * work can stop; a second one ends the process at once. Where whoever started
   * the process has it ignore SIGINT, as nohup does, it goes on to do so.
   *
   * One of many processes is asked by another signal, which start_processes
   * sends through mpirun. When the user stops mpirun itself, it ends its
   * processes by SIGTERM within a second: the first one says what is on disk.
   */
  class Interruption
  {
  public:
    /** Alone: there are no other processes. */
    explicit Interruption(const bool is_alone);
    ~Interruption();
    Interruption(const Interruption &) = delete;
    Interruption &
    operator=(const Interruption &) = delete;

    static bool
    is_wanted();
    /** Whether it has been wanted for longer than a user waits: what is found
     * within a second is finished. */
    static bool
    is_urgent();
    /** What to say where there is no time to ask, a sentence. */
    static void
    know(const std::string &what);
    /** Throws Interrupted: the wish is granted. */
    [[noreturn]] static void
    stop(const std::string &why);
    /** Ends the process as the signal would have. */
    [[noreturn]] static void
    end_process();

    /** What asks one of many processes. */
    static constexpr int forwarded = SIGUSR1;

  private:
    bool
    ends_at_once() const;

    const int        wish; ///< the signal
    struct sigaction before_wish, before_end;
  };
} // namespace conetact

#endif
