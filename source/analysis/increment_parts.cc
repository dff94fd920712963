// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/increment_parts.h"

#include <utility>

namespace conetact::analysis
{
  namespace
  {
    /** Of an increment: what is shorter is not cut. */
    constexpr double shortest = 1.9 / 32, shortest_of_load = 1.9 / 512;
  } // namespace

  bool
  IncrementParts::may_be_cut(const double   begin,
                             const double   duration,
                             const double   whole,
                             const Smallest smallest) const
  {
    return end(whole) - begin >
           duration *
             (smallest == Smallest::of_load ? shortest_of_load : shortest);
  }

  bool
  IncrementParts::cut(const double   begin,
                      const double   duration,
                      const double   whole,
                      const Smallest smallest)
  {
    if (!may_be_cut(begin, duration, whole, smallest))
      return false;
    ends.push_back(begin + .5 * (end(whole) - begin));
    return true;
  }

  bool
  IncrementParts::take(model::IncrementRecord &record)
  {
    const bool is_last = ends.empty();
    if (n_taken > 0)
      add_to(record);
    ++n_taken;
    if (is_last)
      {
        if (n_taken > 1)
          record.report.substeps = n_taken;
        n_taken = 0;
        return true;
      }
    sum = std::move(record);
    ends.pop_back();
    return false;
  }

  void
  IncrementParts::add_to(model::IncrementRecord &record) const
  {
    record.external_work += sum.external_work;
    record.dissipation += sum.dissipation;
    record.contact_work_normal += sum.contact_work_normal;
    record.report.iterations += sum.report.iterations;
    record.pairings += sum.pairings;
    // slips turn with the frames of their nodes
    for (std::size_t i = 0; i < record.rows.size(); ++i)
      record.rows[i].du += sum.rows[i].du;
  }
} // namespace conetact::analysis
