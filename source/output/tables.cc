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
    std::filesystem::path
    begin_table(const std::filesystem::path &file,
                const bool                   is_wanted,
                const std::string           &header)
    {
      if (is_wanted)
        write_atomically(file, header);
      else
        std::filesystem::remove(file);
      return file;
    }
  } // namespace

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
    const std::filesystem::path others =
      begin_table(run.folder / "reactions-2.csv",
                  run.judges_uniqueness,
                  reactions.header());
    if (run.judges_uniqueness)
      others_file.emplace(others);
    const std::filesystem::path all =
      begin_table(run.folder / "solutions.csv",
                  run.follows_branches,
                  "branch,parent," + reactions.header());
    if (run.follows_branches)
      branches_file.emplace(all);
  }



  void
  Tables::write(const std::vector<IncrementRecord> &finished)
  {
    std::string new_reactions, new_increments, new_others, new_branches;
    const auto  publish = [&] {
      try
        {
          reactions_file.add(new_reactions);
          increments_file.add(new_increments);
          reactions_file.publish();
          increments_file.publish();
          for (auto *const file : {&others_file, &branches_file})
            if (*file)
              {
                (*file)->add(file == &others_file ? new_others : new_branches);
                (*file)->publish();
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
            const auto of_solution = [&](const std::vector<ContactRow> &own) {
              IncrementRecord other = record;
              other.rows            = own;
              return reactions.rows(other);
            };
            if (!record.other_rows.empty())
              new_others += of_solution(record.other_rows);
            for (const BranchRows &branch : record.branches)
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
    return {0,
            beginning + reactions_file.n_bytes() + increments_file.n_bytes()};
  }
} // namespace conetact::output
