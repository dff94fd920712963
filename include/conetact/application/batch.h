// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_batch_h
#define conetact_application_batch_h

#include "conetact/application/batch_process.h"
#include "conetact/application/command_line.h"

namespace conetact::application
{
  /**
   * Runs what the lines of `line.batch` say (batch_file.h), `line.jobs` side by
   * side, each in a copy of this process: what has been loaded once is not
   * loaded again. `program` is what a process of its own would do with these
   * arguments; it returns the exit code. Neither MPI nor any thread may have
   * been started before, as copies would have neither.
   *
   * Prints a table with a row for each run, in the order of the lines, each as
   * soon as those above it are there. Returns the largest exit code; that of a
   * run that a signal has ended is 128 and its number, as for shells. Throws
   * InputError before anything runs, WriteError.
   *
   * SIGINT (Ctrl-C) asks the runs to stop, each of which has its row then, and
   * ends the process behind the last line; a second one, SIGTERM and SIGHUP
   * end runs at once.
   */
  int
  run_batch(const CommandLine &line, const MainOfRun &program);
} // namespace conetact::application

#endif
