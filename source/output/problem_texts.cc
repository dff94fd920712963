// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/problem_texts.h"

#include "conetact/base/atomic_file.h"
#include "conetact/output/problem_files.h"

namespace conetact::output
{
  ProblemTexts::ProblemTexts(const RunDescription &description)
    : folder(description.folder)
    , increments(description.text_increments)
  {
    if (!description.goes_on_in_place())
      remove_problem_files(folder, "txt");
  }



  void
  ProblemTexts::write(const std::vector<model::IncrementRecord> &finished)
  {
    for (const model::IncrementRecord &record : finished)
      if (record.condensed && increments.count(record.increment) > 0)
        {
          solvers::StoredProblem stored;
          stored.problem = record.condensed->problem;
          write_problem_text(folder, record.increment, stored);
        }
  }



  void
  write_problem_text(const std::filesystem::path  &folder,
                     const unsigned int            number,
                     const solvers::StoredProblem &stored)
  {
    write_atomically(folder / problem_file_name(number, "txt"),
                     solvers::to_problem_text(stored));
  }
} // namespace conetact::output
