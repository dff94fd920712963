// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/tables.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/output/former_rows.h"

namespace conetact::output
{
  Tables::Tables(const RunDescription &run)
    : reactions(run)
    , increments(run)
    , reactions_file(run.folder / "reactions.csv")
    , increments_file(run.folder / "increments.csv")
  {
    const std::string first_reactions =
      reactions.header() +
      former_rows(run, "reactions.csv", reactions.header());
    const std::string first_increments =
      increments.header() +
      former_rows(run, "increments.csv", increments.header());
    // one rename right after the other
    write_atomically(run.folder / "reactions.csv",
                     [&](const std::filesystem::path &temporary) {
                       write_atomically(temporary, first_reactions);
                       write_atomically(run.folder / "increments.csv",
                                        first_increments);
                     });
    beginning = first_reactions.size() + first_increments.size();
    const std::filesystem::path others = run.folder / "reactions-2.csv";
    if (run.judges_uniqueness)
      {
        write_atomically(others, reactions.header());
        others_file.emplace(others);
      }
    else
      std::filesystem::remove(others);
  }



  void
  Tables::write(const std::vector<IncrementRecord> &finished)
  {
    std::string new_reactions, new_increments, new_others;
    const auto  publish = [&] {
      try
        {
          reactions_file.add(new_reactions);
          increments_file.add(new_increments);
          reactions_file.publish();
          increments_file.publish();
          if (others_file)
            {
              others_file->add(new_others);
              others_file->publish();
            }
        }
      catch (const WriteError &)
        {
          reactions_file.clear();
          increments_file.clear();
          throw;
        }
    };
    try
      {
        for (const IncrementRecord &record : finished)
          {
            const std::string rows = reactions.rows(record);
            new_increments += increments.row(record);
            new_reactions += rows;
            if (!record.other_rows.empty())
              {
                IncrementRecord other = record;
                other.rows            = record.other_rows;
                new_others += reactions.rows(other);
              }
          }
      }
    catch (const AnalysisError &)
      {
        publish(); // those before it
        throw;
      }
    publish();
  }



  OutputWork
  Tables::work() const
  {
    return {0,
            beginning + reactions_file.n_bytes() + increments_file.n_bytes()};
  }
} // namespace conetact::output
