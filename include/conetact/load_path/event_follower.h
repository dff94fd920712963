// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_event_follower_h
#define conetact_load_path_event_follower_h

#include "conetact/load_path/path_events.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace conetact::load_path
{
  /**
   * Follows a load parameter from one change of contact state to the next, [P]:
   * the states give a linear problem, a ratio test says how far it holds, the
   * rate problem decides what comes then. Displacements and reactions follow
   * from the scheme each time; only the slips of stuck nodes are remembered.
   * Where no rates exist for the way the parameter goes, pass_vertex() leads on
   * under the holonomic law. Coulomb's law jumps there: with slips counted from
   * this point on it is the holonomic law, whose path falls back and grows to
   * the same load again in another equilibrium.
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
    using End    = std::optional<PathResult>;

    /** The way of a jump from where a path stands, see jump_by_path(). */
    EventFollower(const EventFollower &path, const Arrival &unloading);

    void
    check_start(const PathStage &stage) const;
    PathResult
    walk(const PathVisitor &visit);
    /** To the next event, or a part of the way; a result if the path ends. */
    End
    advance(const PathVisitor &visit);
    End
    go(const PathEvents  &first,
       const Vector      &velocity,
       const PathVisitor &visit);
    End
    without_rates(const PathVisitor &visit);
    PathResult
    end(const PathOutcome outcome, const std::string &reason = "") const;

    Rates
    next_rates() const;
    Arrival
    unloading() const;
    void
    take(Rates &rates);
    void
    move_to(const double parameter, const Vector &v_rate);
    bool
    move_at_constant_load(const Rates &rates);
    bool
    was_here();

    bool
    jump(std::string &reason);
    bool
    jump_by_path();
    bool
    jump_by_solver(std::string &reason);
    bool
    pivot_beyond(const double p);
    void
    hold_scheme();
    bool
    solve_beyond(const double p, std::string &reason);
    bool
    land();

    PathPoint
    here() const;
    void
    emit(const PathVisitor &visit, const bool always);

    std::shared_ptr<const solvers::ContactSystem> contact;
    PathOptions                                   options;
    std::shared_ptr<const PathSystem>             shared;
    const PathSystem                             &system;
    RatioTest                                     ratio_test;

    PathPosition now;
    SchemeFactor factor; ///< of its scheme

    // the stage
    PathStage              stage;
    Vector                 load_rate; ///< scaled
    double                 lower = 0, upper = 0;
    double                 parameter = 0;
    int                    way       = 1;
    std::optional<Arrival> arrival;
    bool                   plateau = false, jumped = false, turned = false;
    bool                   jumping = false; ///< this is the way of a jump
    unsigned int           n_jumps = 0;
    PathPoint              last; ///< the point visited last

    /** Pieces begun since the parameter has turned for the first time. */
    struct Piece
    {
      Scheme scheme;
      int    way;
      Vector v;
    };
    std::vector<Piece> pieces;
    bool               has_turned = false;
  };
} // namespace conetact::load_path

#endif
