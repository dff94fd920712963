// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_ways_of_wear_h
#define conetact_analysis_ways_of_wear_h

#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/contact/contact_points.h"
#include "conetact/model/increment_record.h"

#include <map>
#include <utility>
#include <vector>

namespace conetact::analysis
{
  /** Warns where nodes that wear slide too far for the depth of the other side:
   * that of an obstacle stays with them, that of a body is left behind in steps
   * of increments. */
  class WaysOfWear
  {
  public:
    /** The scene must outlive the object. */
    explicit WaysOfWear(const application::Scene &s)
      : scene(s)
    {}

    /** An increment, with a row for each point of contact first. */
    void
    see(const contact::ContactPoints         &points,
        const std::vector<model::ContactRow> &rows);
    void
    say(Log &log) const;

  private:
    /** What presses and slips in an increment, of one contact. */
    struct Pressed
    {
      std::vector<const model::ContactRow *> rows;
      const model::ContactRow               *farthest = nullptr;
      double                                 spacing  = 0;
    };
    void
    see_steps(const unsigned int contact, const Pressed &pressed);
    void
    say_unseen(const unsigned int contact, Log &log) const;

    const application::Scene      &scene;
    std::map<unsigned int, double> on_obstacles; ///< by contact [length]
    /** Slip of an increment and what presses along it, of the worst one. */
    std::map<unsigned int, std::pair<double, double>> steps;
  };
} // namespace conetact::analysis

#endif
