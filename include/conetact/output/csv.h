// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_csv_h
#define conetact_output_csv_h

#include "conetact/output/output.h"

#include <string>

namespace conetact::output
{
  /** Appends a number with 15 significant digits, as %.15g does; -0 as 0. */
  void
  append_number(std::string &text, const double number);

  /** The word of a state in tables: open, stick or slip. */
  const char *
  state_name(const solvers::NodeState state);

  /** Contacts and bodies in names of columns and files: only A-Z a-z 0-9 - _ .
   */
  std::string
  safe_name(const std::string &name);
  /** Those of a list, numbered where they would be the same. */
  std::vector<std::string>
  safe_names(const std::vector<std::string> &names);

  /**
   * Rounding noise of forces reads as 0: values below 1e-14 of the largest one
   * seen, which is that of an increment.
   */
  class NoiseFloor
  {
  public:
    void
    see(const double value);
    double
    clean(const double value) const;

  private:
    double largest = 0;
  };

  /** That of all forces of an increment: nodal reactions and resultants. */
  NoiseFloor
  noise_of_forces(const model::IncrementRecord &record);
  /**
   * That of all moments. The noise of a moment is that of a nodal force times
   * its lever, also where all moments cancel.
   */
  NoiseFloor
  noise_of_moments(const model::IncrementRecord &record);

  /** Calls back for contacts, supports, loads, each support, each load. */
  template <typename Function>
  void
  for_each_resultant(const model::IncrementRecord &record, const Function &f)
  {
    for (const model::Resultant &contact : record.contacts)
      f(contact);
    f(record.supports);
    f(record.loads);
    for (const auto *list : {&record.each_support, &record.each_load})
      for (const model::Resultant &resultant : *list)
        f(resultant);
  }

  /** Builds one row of a table; throws AnalysisError at a non-finite number. */
  class CsvRow
  {
  public:
    /** `place` begins the sentence of the error: "Increment 3". */
    CsvRow(std::string &table, std::string place);
    /** `column` is its name in the error. */
    void
    add(const char *column, const double value);
    void
    add(const unsigned int value);
    void
    add(const std::string &value);
    void
    end();

  private:
    void
    separate();

    std::string      &text;
    const std::string where;
    bool              first = true;
  };
} // namespace conetact::output

#endif
