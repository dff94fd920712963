// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_path_events_h
#define conetact_load_path_path_events_h

#include "conetact/load_path/load_path.h"
#include "conetact/load_path/path_rates.h"

#include <memory>
#include <vector>

namespace conetact::load_path
{
  /** Where a path stands, in the scaled quantities of PathSystem. */
  struct PathPosition
  {
    Scheme          scheme;
    Eigen::VectorXd v, r, load;
    CriticalNodes   critical;
    Eigen::VectorXd origin; ///< v from which the holonomic law counts slip

    double
    slip(const Eigen::Index tangent) const
    {
      return v(tangent) - origin(tangent);
    }
  };

  /** States of all nodes under a scheme. */
  std::vector<PathState>
  path_states(const PathSystem &system, const Scheme &scheme);

  /** A non-negative quantity of a node is about to vanish. */
  struct PathEvent
  {
    enum class Hit
    {
      normal, ///< the gap, or the normal reaction
      plus,   ///< the reserve of friction against slip along +t, or the slip
      minus
    };
    double       step; ///< of the parameter, until it vanishes
    double       blur; ///< what round-off makes of the step
    Eigen::Index node;
    Hit          hit;
  };
  using PathEvents = std::vector<PathEvent>;

  /**
   * How far a scheme holds along a straight path, and which nodes stand at a
   * corner of their law.
   */
  class RatioTest
  {
  public:
    RatioTest(std::shared_ptr<const PathSystem> system, const PathLaw law);

    /** All nodes that stand at a corner of their law. */
    CriticalNodes
    critical_nodes(const PathPosition &now) const;
    /**
     * What vanishes along the path, and when; rates that are round-off come as
     * a share of the largest.
     */
    PathEvents
    events(const PathPosition    &now,
           const Eigen::VectorXd &v_rate,
           const Eigen::VectorXd &r_rate,
           const double           noise) const;
    /**
     * The first of them, with all that come at the same time; `from`: the way
     * of the parameter so far.
     */
    static PathEvents
    first(const PathEvents &all, const double from);
    /** Whether the first of them, if any, come at once. */
    static bool
    are_now(const PathEvents &first, const double from);
    /** Makes their nodes critical; true if that is new. */
    bool
    add(const PathEvents &first, PathPosition &now) const;
    /**
     * A node that closes under the holonomic law slips the way it has moved:
     * its guess for the rate problem.
     */
    void
    turn_closing_nodes(const PathPosition &now, Scheme &scheme) const;

  private:
    void
    mark(const PathEvent &event, PathPosition &now) const;

    std::shared_ptr<const PathSystem> shared;
    const PathSystem                 &system;
    PathLaw                           law;
  };

  /** Quantities below this share of the largest have vanished. */
  constexpr double value_tolerance = 1e-12;
} // namespace conetact::load_path

#endif
