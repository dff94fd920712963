// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_work_h
#define conetact_analysis_work_h

#include "conetact/base/log.h"
#include "conetact/base/team.h"
#include "conetact/condensed/schur_solver.h"
#include "conetact/output/output.h"
#include "conetact/solvers/contact_problem.h"

#include <cstdint>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * What an analysis has done, in numbers that are the same on every machine:
   * tests bound them in place of seconds.
   */
  struct Work
  {
    condensed::SchurWork elastic;                  ///< with the elastic system
    unsigned int         contact_solves       = 0; ///< linear, or sweeps
    unsigned int         dense_factorizations = 0; ///< of contact unknowns
    unsigned int         krylov               = 0; ///< iterations without them
    unsigned int         load_integrations    = 0;
    std::uint64_t        elements = 0; ///< that this process has looked at
    output::OutputWork   outputs;

    void
    add(const solvers::SolverReport &report);
  };

  /** "work: 1 factorisations of the elastic system, ...", in one line. */
  std::string
  describe(const Work &work);

  /** The same with memory, elements and what many processes needed, to the
   * log. */
  void
  note_work(const Work &work, const std::vector<Needs> &processes, Log &log);
} // namespace conetact::analysis

#endif
