// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/tables.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/output/former_rows.h"

namespace conetact::output
{
  Tables::Tables(const RunDescription &run)
    : folder(run.folder)
    , reactions(run)
    , increments(run)
    , reactions_text(reactions.header() +
                     former_rows(run, "reactions.csv", reactions.header()))
    , increments_text(increments.header() +
                      former_rows(run, "increments.csv", increments.header()))
  {
    rewrite();
  }



  void
  Tables::write(const std::vector<IncrementRecord> &finished)
  {
    try
      {
        for (const IncrementRecord &record : finished)
          append(record);
      }
    catch (const AnalysisError &)
      {
        rewrite(); // with those before it
        throw;
      }
    rewrite();
  }



  OutputWork
  Tables::work() const
  {
    return {0, bytes};
  }



  void
  Tables::append(const IncrementRecord &record)
  {
    const std::string rows = reactions.rows(record);
    increments_text += increments.row(record);
    reactions_text += rows;
  }



  void
  Tables::rewrite()
  {
    // one rename right after the other
    write_atomically(folder / "reactions.csv",
                     [this](const std::filesystem::path &temporary) {
                       write_atomically(temporary, reactions_text);
                       write_atomically(folder / "increments.csv",
                                        increments_text);
                     });
    bytes += reactions_text.size() + increments_text.size();
  }
} // namespace conetact::output
