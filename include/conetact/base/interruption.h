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
   */
  class Interruption
  {
  public:
    Interruption();
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
    /** Throws Interrupted: the wish is granted. */
    [[noreturn]] static void
    stop(const std::string &why);
    /** Ends the process as the signal would have. */
    [[noreturn]] static void
    end_process();

  private:
    struct sigaction before;
  };
} // namespace conetact

#endif
