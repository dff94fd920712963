// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_team_h
#define conetact_base_team_h

#include "conetact/base/communicator.h"

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace conetact
{
  /*
   * Every process of a run executes the program on the same scene. All of them
   * are a team to begin with: they are in the same place of the program, know
   * the same of scene, contacts and history, and take the same decisions; each
   * has its own part of large systems. Where the scene is too small to be
   * shared, the first process goes on alone and the others wait for its end.
   */

  /** The processes that are at work; this one alone where there are no others.
   */
  const Communicator &
  team();

  /** All processes of the run call this: the first n of them go on together. */
  void
  form_team(const int n);

  /** False: this process has nothing to do until the first one ends or runs
   * another mesh. */
  bool
  is_in_team();

  /** The first process goes on alone: the others are in no team any more. */
  void
  leave_to_first();

  /** Processes that share so many unknowns: each has `fewest` at least. */
  int
  processes_for(const Eigen::Index n_unknowns, const Eigen::Index fewest);

  /**
   * Runs f on all processes of the team. If it throws on some of them, all of
   * them throw: what the first of these has found, as InputError,
   * AnalysisError, WriteError or std::bad_alloc. Whatever one process
   * does for all, such as writing files, belongs into such an f.
   */
  void
  agree(const std::function<void()> &f);

  /** Of what may differ between machines, such as their memory. */
  void
  first_decides(bool &decision);
  void
  first_decides(double &number);
  void
  first_decides(std::string &text);

  /** Whether the run is to be interrupted: the first process has been asked.
   * All processes of the team call this. */
  bool
  wants_to_stop();

  /** Throws AnalysisError on all processes of the team unless these numbers
   * are the same on each, to the last bit: arrays and how long they are. */
  void
  demand_equal(
    const std::vector<std::pair<const double *, Eigen::Index>> &numbers);

  /** What this process does not know: that another one has ended the run. */
  struct EndedByOther : std::runtime_error
  {
    explicit EndedByOther(const int exit_code)
      : std::runtime_error("another process has ended the run")
      , code(exit_code)
    {}
    const int code;
  };

  /** Of meet(): the run goes on. */
  constexpr int goes_on = -1;

  /**
   * All processes of the run meet here, each with goes_on or the exit code that
   * it ends with. Returns those of all. Nothing where this process has failed
   * and others do not come: they wait for something that it has not sent.
   */
  std::vector<int>
  meet(const int code);

  /** What a process has needed so far. */
  struct Needs
  {
    double peak_memory = 0; ///< [bytes]
    double cpu_seconds = 0;
    double elements    = 0;         ///< that it has looked at
    double ghosts      = 0;         ///< most nodes of others in one exchange
    double messages = 0, bytes = 0; ///< to neighbours
    double n_collective = 0, collective_bytes = 0; ///< what all do, its part
    double waited = 0; ///< of cpu_seconds, for others
  };
  /** Of each process of the team, of which this one has looked at so many
   * elements. */
  std::vector<Needs>
  needs_of_processes(const std::uint64_t elements);
} // namespace conetact

#endif
