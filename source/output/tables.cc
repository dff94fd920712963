// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/tables.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/output/former_rows.h"

namespace conetact::output
{
  namespace
  {
    /** Each line with what stands before it. */
    std::string
    with_prefix(const std::string &prefix, const std::string &lines)
    {
      std::string result;
      for (std::size_t begin = 0; begin < lines.size();)
        {
          const std::size_t end = lines.find('\n', begin) + 1;
          result += prefix + lines.substr(begin, end - begin);
          begin = end;
        }
      return result;
    }

    /** A table of something that only some runs look for. */
    void
    begin_table(const std::filesystem::path &file,
                const bool                   is_wanted,
                const std::string           &header)
    {
      if (is_wanted)
        write_atomically(file, header);
      else
        std::filesystem::remove(file);
    }
  } // namespace

  Tables::Tables(const RunDescription &run)
    : reactions(run)
    , increments(run)
    , folder(run.folder)
    , has_others(run.judges_uniqueness)
    , has_branches(run.follows_branches)
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
    n_bytes = first_reactions.size() + first_increments.size();
    begin_table(folder / "reactions-2.csv", has_others, reactions.header());
    begin_table(folder / "solutions.csv",
                has_branches,
                "branch,parent," + reactions.header());
  }



  void
  Tables::write(const std::vector<model::IncrementRecord> &finished)
  {
    std::string new_reactions, new_increments, new_others, new_branches;
    const auto  publish = [&] {
      append_to_file(folder / "reactions.csv", new_reactions);
      append_to_file(folder / "increments.csv", new_increments);
      n_bytes += new_reactions.size() + new_increments.size();
      if (has_others)
        append_to_file(folder / "reactions-2.csv", new_others);
      if (has_branches)
        append_to_file(folder / "solutions.csv", new_branches);
    };
    try
      {
        for (const model::IncrementRecord &record : finished)
          {
            const std::string rows = reactions.rows(record);
            new_increments += increments.row(record);
            new_reactions += rows;
            const auto of_solution =
              [&](const std::vector<model::ContactRow> &own) {
                model::IncrementRecord other = record;
                other.rows                   = own;
                return reactions.rows(other);
              };
            if (!record.other_rows.empty())
              new_others += of_solution(record.other_rows);
            for (const model::BranchRows &branch : record.branches)
              new_branches += with_prefix(std::to_string(branch.number) + ',' +
                                            std::to_string(branch.parent) + ',',
                                          of_solution(branch.rows));
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
    return {0, n_bytes};
  }
} // namespace conetact::output
