// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_wear_error_h
#define conetact_analysis_wear_error_h

#include "conetact/base/archive.h"
#include "conetact/base/log.h"
#include "conetact/contact/wear.h"

#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * What Wear acceleration = N does to depths of wear, beside half of it: each
   * increment happens twice there, with half of the wear, on gaps that have
   * worn so. Cycles are not known: it is not all of a cycle that happens twice.
   */
  class WearError
  {
  public:
    /** The points must outlive the object. */
    explicit WearError(const contact::ContactPoints &points);

    /** Whether a contact wears faster than its slips. */
    bool
    is_asked() const
    {
      return !accelerated.empty();
    }
    /** What has worn so far, in the run and where each increment has happened
     * twice after half of its wear. */
    void
    set(const contact::Wear &sum, const contact::Wear &by_halves);
    /** What the latter has lost more: of candidates, and of masters. */
    const Eigen::VectorXd &
    difference() const
    {
      return error;
    }
    const Eigen::VectorXd &
    difference_of_sides() const
    {
      return error_of_sides;
    }
    /** An increment that has no estimate. */
    void
    miss()
    {
      ++n_missed;
    }

    /** A sentence for each contact, a warning if the error is large. */
    void
    report(const std::vector<std::string> &contacts, Log &log) const;
    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive);

  private:
    void
    report(const unsigned int contact, const std::string &name, Log &log) const;

    const contact::ContactPoints &points;
    std::vector<unsigned int>     accelerated; ///< contacts
    Eigen::VectorXd               error, depth, error_of_sides;
    unsigned int                  n_missed = 0;
  };
} // namespace conetact::analysis

#endif
