// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/problem_files.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>
#ifdef CONETACT_HAVE_FCLIB
#  include "conetact/exchange/fclib_file.h"
#endif

#include <cstdio>
#include <regex>

namespace conetact::output
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string fclib_entry = "Output, FCLib increments";

    bool
    is_problem_file(const fs::path &file, const std::string &ending)
    {
      return std::regex_match(file.filename().string(),
                              std::regex("problem-[0-9]{4,}\\." + ending));
    }

    [[noreturn]] void
    refuse(const std::string &why)
    {
      throw InputError(fclib_entry + ": " + why + " Leave the entry empty.");
    }

    unsigned int
    parse_increment(const std::string &text,
                    const unsigned int n,
                    const std::string &entry)
    {
      if (!std::regex_match(text, std::regex("[0-9]{1,9}")))
        throw InputError(entry + ": '" + text +
                         "' is not the number of an increment. Give numbers "
                         "separated by commas, or all.");
      const unsigned long k = std::stoul(text);
      if (k < 1 || k > n)
        throw InputError(entry + ": there is no increment " + text +
                         "; they count from 1 to " + std::to_string(n) + ".");
      return static_cast<unsigned int>(k);
    }
  } // namespace



  ProblemFiles::ProblemFiles(const RunDescription &description)
    : folder(description.folder)
    , increments(description.fclib_increments)
  {
    if (!description.goes_on_in_place())
      remove_problem_files(folder, "hdf5");
  }



  void
  ProblemFiles::write(const std::vector<model::IncrementRecord> &finished)
  {
    for (const model::IncrementRecord &record : finished)
      if (record.condensed && increments.count(record.increment) > 0)
        write_problem(record);
  }



  void
  ProblemFiles::write_problem(
    [[maybe_unused]] const model::IncrementRecord &record)
  {
#ifdef CONETACT_HAVE_FCLIB
    const model::CondensedIncrement &condensed = *record.condensed;
    const std::string                increment =
      "increment " + std::to_string(record.increment);
    try
      {
        exchange::write_fclib(
          condensed.problem,
          (folder / problem_file_name(record.increment, "hdf5")).string(),
          condensed.solution ? &*condensed.solution : nullptr,
          nullptr,
          "Conetact, " + increment);
      }
    catch (const InputError &error)
      {
        throw AnalysisError(fclib_entry + ", " + increment + ": " +
                            error.what());
      }
#endif
  }



  std::string
  problem_file_name(const unsigned int number, const std::string &ending)
  {
    Assert(number >= 1, dealii::ExcMessage("Increments count from 1."));
    char name[32];
    std::snprintf(name, sizeof(name), "problem-%04u.", number);
    return name + ending;
  }



  void
  remove_problem_files(const std::filesystem::path &folder,
                       const std::string           &ending)
  {
    std::error_code error;
    for (const auto &file : fs::directory_iterator(folder, error))
      if (is_problem_file(file.path(), ending))
        fs::remove(file.path(), error);
  }



  std::set<unsigned int>
  parse_problem_increments(const std::string &text,
                           const unsigned int n,
                           const std::string &entry)
  {
    std::set<unsigned int> increments;
    if (trim(text) == "all")
      for (unsigned int k = 1; k <= n; ++k)
        increments.insert(k);
    else
      for (const std::string &part : split(text, ','))
        increments.insert(parse_increment(part, n, entry));
    return increments;
  }



  void
  check_fclib_is_there(
    [[maybe_unused]] const std::set<unsigned int> &increments)
  {
#ifndef CONETACT_HAVE_FCLIB
    if (!increments.empty())
      refuse("this program was built without FCLib (Debian: libfclib-dev, "
             "libhdf5-dev).");
#endif
  }



  void
  check_problem_is_writable(const solvers::ContactSystem &system)
  {
    if (system.n_nodes() == 0)
      refuse("no node may touch anything, there is no contact problem.");
    if (system.null_space.cols() > 0)
      refuse("a body is held by contact alone, its stiffness has no inverse, "
             "and FCLib knows no other form.");
    const Eigen::Index tangents = system.n_tangents(0);
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      if (system.n_tangents(i) == 0 || system.n_tangents(i) != tangents)
        refuse("FCLib needs contacts of one kind, but contact " +
               std::to_string(i) + " has " +
               std::to_string(system.n_tangents(i)) +
               " free tangents with friction, contact 0 has " +
               std::to_string(tangents) + ".");
  }
} // namespace conetact::output
