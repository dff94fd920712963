// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/work.h"

#include "conetact/analysis/cost.h"
#include "conetact/base/text.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace conetact::analysis
{
  void
  Work::add(const solvers::SolverReport &report)
  {
    contact_solves += report.iterations;
    dense_factorizations += report.factorizations;
    krylov += report.krylov;
  }



  std::string
  describe(const Work &work)
  {
    const std::pair<std::uint64_t, const char *> counts[] = {
      {work.elastic.factorizations, "factorisations of the elastic system"},
      {work.elastic.condensations, "condensations"},
      {work.elastic.reductions, "reductions of loads"},
      {work.elastic.expansions, "recoveries of displacements"},
      {work.elastic.triangular_solves, "triangular solves"},
      {work.contact_solves, "linear solves of contact"},
      {work.dense_factorizations, "dense factorisations"},
      {work.krylov, "linear iterations"},
      {work.load_integrations, "integrations of loads"},
      {work.outputs.drawings, "increments drawn"},
      {work.outputs.table_bytes, "bytes of tables written"}};
    std::string text;
    for (const auto &[count, what] : counts)
      text +=
        (text.empty() ? "work: " : ", ") + std::to_string(count) + " " + what;
    return text;
  }



  void
  note_work(const Work &work, const std::vector<Needs> &processes, Log &log)
  {
    log.note("memory: " + megabytes(peak_memory()) + " at most");
    if (processes.size() > 1)
      {
        std::string memory, time, elements;
        for (const Needs &needs : processes)
          {
            const char *const comma = memory.empty() ? "" : ", ";
            memory += comma + megabytes(needs.peak_memory);
            time +=
              comma + to_text(std::round(10 * needs.cpu_seconds) / 10) + " s";
            elements += comma + std::to_string(std::llround(needs.elements));
          }
        log.note("memory of processes: " + memory);
        log.note("CPU of processes: " + time);
        log.note("elements seen by processes: " + elements);
      }
    else
      log.note("elements seen: " + std::to_string(work.elements));
    log.note(describe(work));
  }
} // namespace conetact::analysis
