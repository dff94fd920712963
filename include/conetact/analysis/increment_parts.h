// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_increment_parts_h
#define conetact_analysis_increment_parts_h

#include "conetact/output/output.h"

#include <vector>

namespace conetact::analysis
{
  /**
   * An increment in which bodies slide too far at once is cut in halves, and
   * these again. Its parts are increments that nobody sees: works, slips and
   * counts of what is written are the sums of theirs.
   */
  class IncrementParts
  {
  public:
    /** Where the part that is next ends, of an increment up to `whole`. */
    double
    end(const double whole) const
    {
      return ends.empty() ? whole : ends.back();
    }
    /** Whether the increment has been cut. */
    bool
    is_cut() const
    {
      return others_follow() || n_taken > 0;
    }
    /** Whether others follow the part that is next. */
    bool
    others_follow() const
    {
      return !ends.empty();
    }
    /** How small parts may be: those of a load that comes to its limit show
     * where that is. */
    enum class Smallest
    {
      of_sliding,
      of_load
    };

    /**
     * Cuts the part that is next in two; it starts at `begin`, its increment
     * takes `duration` and ends at `whole`. False: it is small enough.
     */
    bool
    cut(const double   begin,
        const double   duration,
        const double   whole,
        const Smallest smallest = Smallest::of_sliding);
    /** Whether cut() would do so. */
    bool
    may_be_cut(const double   begin,
               const double   duration,
               const double   whole,
               const Smallest smallest = Smallest::of_sliding) const;

    /** Whether the part that is next is more than a quarter of its increment.
     */
    bool
    is_long(const double begin, const double duration, const double whole) const
    {
      return end(whole) - begin > .3 * duration;
    }

    /** A part was accepted. Returns whether it was the last one, whose record
     * becomes that of the increment. */
    bool
    take(model::IncrementRecord &record);

  private:
    void
    add_to(model::IncrementRecord &record) const;

    std::vector<double>    ends; ///< of parts to come, the next one last
    model::IncrementRecord sum;
    unsigned int           n_taken = 0;
  };
} // namespace conetact::analysis

#endif
