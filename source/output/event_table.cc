// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/event_table.h"

#include "conetact/base/atomic_file.h"
#include "conetact/output/csv.h"

namespace conetact::output
{
  EventTable::EventTable(const std::filesystem::path &folder)
    : file(folder / "events.csv")
    , text("event,parameter,node,from,to,load\n")
  {
    write();
  }



  void
  EventTable::add(const double               parameter,
                  const std::vector<Change> &changes,
                  const std::string         &load)
  {
    ++n;
    for (const Change &change :
         changes.empty() ? std::vector<Change>(1) : changes)
      {
        CsvRow row(text, "Event " + std::to_string(n));
        row.add(n);
        row.add("the parameter", parameter);
        row.add(change.node);
        row.add(change.from);
        row.add(change.to);
        row.add(load);
        row.end();
      }
  }



  void
  EventTable::write() const
  {
    write_atomically(file, text);
  }



  void
  EventTable::finish(const double parameter, const std::string &words)
  {
    CsvRow row(text, "The outcome");
    row.add(std::string("outcome"));
    row.add("the parameter", parameter);
    row.add(std::string());
    row.add(std::string());
    row.add(words);
    row.add(std::string());
    row.end();
    write();
  }
} // namespace conetact::output
