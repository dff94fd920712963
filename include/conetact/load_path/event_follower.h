// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_event_follower_h
#define conetact_load_path_event_follower_h

#include "conetact/load_path/path_events.h"

#include <memory>
#include <string>

namespace conetact::load_path
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
    EventFollower(std::shared_ptr<const solvers::ContactSystem> system,
                  const Eigen::VectorXd                        &gap,
                  const PathOptions                            &options);

    PathResult
    follow(const PathStage &stage, const PathVisitor &visit) override;

  private:
    using Vector = Eigen::VectorXd;

    void
    check_start(const PathStage &stage) const;
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

    PathPoint
    here() const;
    void
    emit(const PathVisitor &visit, const bool always);

    std::shared_ptr<const solvers::ContactSystem> contact;
    PathOptions                                   options;
    PathSystem                                    system;
    RatioTest                                     ratio_test;

    PathPosition now;
    SchemeFactor factor; ///< of its scheme

    // the stage
    PathStage stage;
    double    parameter = 0;
    bool      plateau = false, jumped = false;
    PathPoint last; ///< the point visited last
  };
} // namespace conetact::load_path

#endif
