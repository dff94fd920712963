// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_event_follower_h
#define conetact_solvers_event_follower_h

#include "conetact/solvers/load_path.h"
#include "conetact/solvers/path_rates.h"

#include <vector>

namespace conetact
{
  /**
   * Follows a load parameter from one change of contact state to the next, [P]:
   * the states give a linear problem, a ratio test says how far it holds, the
   * rate problem decides what comes then. Displacements and reactions follow
   * from the scheme each time; only the slips of stuck nodes are remembered.
   */
  class EventFollower : public PathFollower
  {
  public:
    EventFollower(std::shared_ptr<const ContactSystem> system,
                  const Eigen::VectorXd               &gap,
                  const PathOptions                   &options);

    PathResult
    follow(const PathStage &stage, const PathVisitor &visit) override;

  private:
    using Index  = Eigen::Index;
    using Vector = Eigen::VectorXd;

    /** A non-negative quantity of a node that is about to vanish. */
    enum class Hit
    {
      normal, ///< the gap, or the normal reaction
      plus,   ///< the reserve of friction against slip along +t, or the slip
      minus
    };
    struct Event
    {
      double step; ///< of the parameter, until it vanishes
      double blur; ///< what round-off makes of the step
      Index  node;
      Hit    hit;
    };

    void
    check_start(const PathStage &stage) const;
    CriticalNodes
    critical_nodes() const;
    void
    mark(const Event &event, CriticalNodes &critical) const;
    /** Rates that are round-off come as a share of the largest. */
    std::vector<Event>
    events(const Vector &v_rate,
           const Vector &r_rate,
           const double  noise) const;
    /** The first of them, with all that come at the same time. */
    std::vector<Event>
    first_events(const std::vector<Event> &all, const double from) const;
    /** True if critical nodes have been added. */
    bool
    add(const std::vector<Event> &first);

    void
    turn_closing_nodes();
    void
    take(Rates &rates);
    void
    move_to(const double parameter, const Vector &v_rate);
    bool
    move_at_constant_load(const Vector &velocity);
    bool
    solve_beyond(const double p, std::string &reason);
    bool
    jump(const PathVisitor &visit, PathResult &result);
    PathResult
    end_without_rates(PathResult result);

    std::vector<PathState>
    path_states() const;
    PathPoint
    here() const;
    void
    emit(const PathVisitor &visit, const bool always);

    std::shared_ptr<const ContactSystem> contact;
    PathOptions                          options;
    PathSystem                           system;

    // where the path stands, scaled
    Scheme        scheme;
    SchemeFactor  factor;
    Vector        v, r, load;
    CriticalNodes critical;

    // the stage
    PathStage stage;
    double    parameter = 0;
    bool      plateau = false, jumped = false;
    PathPoint last; ///< the point visited last
  };
} // namespace conetact

#endif
