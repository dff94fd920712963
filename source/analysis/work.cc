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



  namespace
  {
    /** "what: a, b, c", a number of each process. */
    template <typename Number>
    void
    note_each(const std::string        &what,
              const std::vector<Needs> &processes,
              const Number             &number,
              Log                      &log)
    {
      std::string text;
      for (const Needs &needs : processes)
        text += (text.empty() ? "" : ", ") + number(needs);
      log.note(what + ": " + text);
    }

    void
    note_processes(const std::vector<Needs> &processes, Log &log)
    {
      const auto count = [](const double Needs::*of) {
        return [of](const Needs &needs) {
          return std::to_string(std::llround(needs.*of));
        };
      };
      note_each(
        "memory of processes",
        processes,
        [](const Needs &needs) { return megabytes(needs.peak_memory); },
        log);
      const auto seconds = [](const double Needs::*of) {
        return [of](const Needs &needs) {
          return to_text(std::round(100 * needs.*of) / 100) + " s";
        };
      };
      note_each("CPU of processes",
                processes,
                seconds(&Needs::cpu_seconds),
                log);
      note_each("  of which waiting", processes, seconds(&Needs::waited), log);
      note_each("elements seen by processes",
                processes,
                count(&Needs::elements),
                log);
      note_each("nodes of others in one exchange",
                processes,
                count(&Needs::ghosts),
                log);
      note_each("messages to neighbours",
                processes,
                count(&Needs::messages),
                log);
      note_each("  their bytes", processes, count(&Needs::bytes), log);
      note_each("sums and lists of all processes",
                processes,
                count(&Needs::n_collective),
                log);
      note_each("  bytes of their parts",
                processes,
                count(&Needs::collective_bytes),
                log);
    }
  } // namespace

  void
  note_work(const Work &work, const std::vector<Needs> &processes, Log &log)
  {
    log.note("memory: " + megabytes(peak_memory()) + " at most");
    if (processes.size() > 1)
      note_processes(processes, log);
    else
      log.note("elements seen: " + std::to_string(work.elements));
    log.note(describe(work));
  }
} // namespace conetact::analysis
