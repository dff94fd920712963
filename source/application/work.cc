// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/work.h"

#include <utility>

namespace conetact
{
  void
  Work::add(const SolverReport &report)
  {
    contact_solves += report.iterations;
    dense_factorizations += report.factorizations;
  }



  std::string
  describe(const Work &work)
  {
    std::string text;
    for (const auto &[count, what] :
         {std::pair(work.elastic.factorizations,
                    "factorisations of the elastic system"),
          std::pair(work.elastic.condensations, "condensations"),
          std::pair(work.elastic.reductions, "reductions of loads"),
          std::pair(work.elastic.expansions, "recoveries of displacements"),
          std::pair(work.elastic.triangular_solves, "triangular solves"),
          std::pair(work.contact_solves, "linear solves of contact"),
          std::pair(work.dense_factorizations, "dense factorisations")})
      text +=
        (text.empty() ? "work: " : ", ") + std::to_string(count) + " " + what;
    return text;
  }
} // namespace conetact
