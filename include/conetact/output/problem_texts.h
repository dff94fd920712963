// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_problem_texts_h
#define conetact_output_problem_texts_h

#include "conetact/output/output.h"
#include "conetact/solvers/problem_text.h"

namespace conetact::output
{
  /**
   * `problem-0001.txt`: the condensed problem of chosen increments in the
   * format of to_problem_text(), for conetact-reproductions and for scripts.
   * Any system has a place in it, also that of bodies that float.
   */
  class ProblemTexts : public Output
  {
  public:
    /** Removes files of this name that an earlier run left. */
    explicit ProblemTexts(const RunDescription &description);
    void
    write(const std::vector<model::IncrementRecord> &finished) override;

  private:
    const std::filesystem::path  folder;
    const std::set<unsigned int> increments;
  };

  /** The file of an increment, or of a stage of a load path. */
  void
  write_problem_text(const std::filesystem::path  &folder,
                     const unsigned int            number,
                     const solvers::StoredProblem &stored);
} // namespace conetact::output

#endif
