// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_event_table_h
#define conetact_output_event_table_h

#include <filesystem>
#include <string>
#include <vector>

namespace conetact::output
{
  /**
   * `events.csv` of a load path, columns `event,parameter,node,from,to`: a row
   * for each node that changes its state; nodes that change together share the
   * number of the event, which counts from 1. The last line is the outcome,
   * `outcome,<parameter>,,,<words>`. Rewritten and started like ReactionTable.
   */
  class EventTable
  {
  public:
    explicit EventTable(const std::filesystem::path &folder);

    struct Change
    {
      std::string node, from, to;
    };
    /**
     * All changes of one event, to be written with others; without any it is a
     * row of its own. `load`: what the load does there, "rises".
     */
    void
    add(const double               parameter,
        const std::vector<Change> &changes,
        const std::string         &load);
    void
    write() const;
    /** The last line, written at once. */
    void
    finish(const double parameter, const std::string &words);

  private:
    const std::filesystem::path file;
    std::string                 text;
    unsigned int                n = 0;
  };
} // namespace conetact::output

#endif
