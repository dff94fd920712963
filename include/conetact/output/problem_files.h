// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_problem_files_h
#define conetact_output_problem_files_h

#include "conetact/output/output.h"

#include <set>
#include <string>

namespace conetact::output
{
  /**
   * `problem-0001.hdf5`: the condensed problem of chosen increments as a local
   * problem of FCLib, @f$ u = W r + q @f$ with u = (new gap, slip of the
   * increment) [length] and r the total reaction [force], and the solution
   * found (not where the increment was solved in parts). Contacts stand in the
   * order of the rows of `reactions.csv`; where friction is elliptic their
   * tangential components are scaled so that the cone is circular.
   */
  class ProblemFiles : public Output
  {
  public:
    /** Removes files of this name that an earlier run left. */
    explicit ProblemFiles(const RunDescription &description);
    void
    write(const std::vector<model::IncrementRecord> &finished) override;

  private:
    void
    write_problem(const model::IncrementRecord &record);

    const std::filesystem::path  folder;
    const std::set<unsigned int> increments;
  };

  /** `problem-0001.ending` */
  std::string
  problem_file_name(const unsigned int number, const std::string &ending);

  /** Those of an earlier run. */
  void
  remove_problem_files(const std::filesystem::path &folder,
                       const std::string           &ending);

  /**
   * Increments to be written, of 1, ..., n: numbers separated by commas, all,
   * or none. Throws InputError that names the entry.
   */
  std::set<unsigned int>
  parse_problem_increments(const std::string &text,
                           const unsigned int n,
                           const std::string &entry);

  /** Throws InputError where the program was built without FCLib. */
  void
  check_fclib_is_there(const std::set<unsigned int> &increments);

  /**
   * Throws InputError where the problem has no place in the format: floating
   * bodies, contacts with different numbers of tangents, no contact at all.
   */
  void
  check_problem_is_writable(const solvers::ContactSystem &system);
} // namespace conetact::output

#endif
