// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_wear_error_h
#define conetact_analysis_wear_error_h

#include "conetact/base/archive.h"
#include "conetact/base/log.h"
#include "conetact/contact/contact_points.h"

#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * What Wear acceleration = N does to depths of wear, beside half of it in
   * twice as many increments. With the depth @f$\Delta h@f$ that an increment
   * wears, and @f$\Delta h'@f$ what it would wear if half of @f$\Delta h@f$
   * had worn before, two halves wear
   * @f$\frac12(\Delta h + \Delta h')@f$: each increment is off by
   * @f$\frac12(\Delta h' - \Delta h)@f$ (implicit integration: by as much
   * the other way). An error from before changes by
   * @f$2(\Delta h' - \Delta h)/\Delta h@f$ of itself, node by node, and
   * does not grow. All this is of first order in N.
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
    /** Depths of wear of all candidates: of an increment, of the same after
     * half of it, and all so far with it [length]. */
    void
    add(const Eigen::VectorXd &worn,
        const Eigen::VectorXd &after_half,
        const Eigen::VectorXd &sum);
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
    Eigen::VectorXd               error, depth;
    unsigned int                  n_missed = 0;
  };
} // namespace conetact::analysis

#endif
