// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_batch_process_h
#define conetact_application_batch_process_h

#include "conetact/application/batch_file.h"

#include <sys/types.h>

#include <functional>
#include <string>

namespace conetact::application
{
  /** What a process of its own would do with these arguments; returns the exit
   * code. */
  using MainOfRun = std::function<int(int, char *const[])>;

  /**
   * Where a run prints to. What it says on standard error is read again, for
   * the table.
   */
  class BatchStreams
  {
  public:
    /** Opens the files of the run. Throws WriteError. */
    explicit BatchStreams(const BatchRun &run);
    ~BatchStreams();
    BatchStreams(const BatchStreams &) = delete;
    BatchStreams &
    operator=(const BatchStreams &) = delete;

    /** The last line of standard error, without the name of the program. */
    std::string
    said() const;

    const int out, err;
  };

  /**
   * A copy of this process that does runs of a batch, one after the other: what
   * one has loaded, started and touched serves the next. It ends, with the exit
   * code of its run, behind one that has not succeeded or has taken much
   * memory, so that no run sees what has gone wrong in another.
   *
   * Ends the copy when it is destroyed.
   */
  class BatchProcess
  {
  public:
    /** Forks. The copy calls `begin` first. Throws WriteError. */
    BatchProcess(const MainOfRun &program, const std::function<void()> &begin);
    ~BatchProcess();
    BatchProcess(const BatchProcess &) = delete;
    BatchProcess &
    operator=(const BatchProcess &) = delete;

    /** Hands a run over. Returns false if the process has ended. */
    bool
    start(const BatchRun &run, const BatchStreams &streams) const;

    /** The run has succeeded, and there may be another one: to be called when
     * `channel` can be read. */
    bool
    is_ready() const;

    /** Signals of a terminal do not reach it by themselves. */
    void
    send(const int signal) const;

    /** The process has ended and has been waited for. */
    void
    see_end();

    pid_t
    id() const;
    /** To be polled. */
    int
    channel() const;

  private:
    pid_t child = -1;
    int   ours  = -1; ///< end of the channel
  };
} // namespace conetact::application

#endif
