// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_batch_file_h
#define conetact_application_batch_file_h

#include <optional>
#include <string>
#include <vector>

namespace conetact::application
{
  /** One run of a batch. */
  struct BatchRun
  {
    unsigned int             number = 0;    ///< of its line, from 1
    std::vector<std::string> words;         ///< scene and options
    std::string              out, err;      ///< files; empty: none
    std::string              name;          ///< its folder, or its scene
    bool                     writes = true; ///< results, into the folder
    /** It needs a process in which there was no run before: estimates count
     * what the process has used, mpirun wants its environment, and what has
     * come through a pipe is kept. */
    bool alone = false;
  };

  /**
   * What a line says, none if it is blank or a comment. Words are those of a
   * shell: blanks part them, quotes and backslashes keep blanks in them, #
   * begins a comment, > FILE and 2> FILE take what the run prints. Throws
   * InputError.
   */
  std::optional<BatchRun>
  parse_batch_line(const std::string &text, const unsigned int number);

  /** Finds out what a run writes. Throws InputError if its options are wrong or
   * run no scene. */
  void
  check_batch_run(BatchRun &run);

  /**
   * All runs of a file. Throws InputError that names every wrong line, also
   * those that write into the folder of another one.
   */
  std::vector<BatchRun>
  read_batch_file(const std::string &file);
} // namespace conetact::application

#endif
