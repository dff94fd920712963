// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_load_path_h
#define conetact_load_path_load_path_h

#include "conetact/solvers/contact_solver.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace conetact::load_path
{
  /** Which displacement the friction law looks at. */
  enum class PathLaw
  {
    incremental, ///< its rate: Coulomb's law, that of the increments
    holonomic    ///< its total: the law of [P]
  };

  /**
   * State of a contact node on a path. `slip` has no sign: in 3D, and where
   * there is no friction. With cohesion open nodes stick and slip, too.
   */
  enum class PathState : unsigned char
  {
    open,
    stick,
    slip_plus,  ///< slips along +t, r_t = -(mu r_n + c)
    slip_minus, ///< slips along -t, r_t = +(mu r_n + c)
    slip,
    open_plus, ///< open, slips along +t against its cohesion, r_t = -c
    open_minus ///< open, slips along -t against its cohesion, r_t = +c
  };

  struct PathOptions
  {
    PathLaw         law       = PathLaw::incremental;
    double          tolerance = 1e-10; ///< of the unit-free check of each point
    Eigen::VectorXd cohesion; ///< c >= 0 of each node [force]; empty: none
  };

  /**
   * Loads f = load + (p - begin) * rate while p goes from begin to end. A stage
   * starts with the loads the one before it ended with; the first one, where
   * nothing has happened yet, with f = K (0, gap).
   */
  struct PathStage
  {
    Eigen::VectorXd load; ///< f of ContactProblem in total terms: K v = r + f
    Eigen::VectorXd rate; ///< df/dp
    double          begin = 0, end = 1;
  };

  struct PathChange
  {
    Eigen::Index node;
    PathState    from, to;
  };

  /** A point of the path: an event, or the end of a stage (no changes). */
  struct PathPoint
  {
    double          parameter = 0;
    Eigen::VectorXd v; ///< (tangential displacement, gap), total [length]
    Eigen::VectorXd r; ///< total reactions on the body [force]
    std::vector<PathState>  state;   ///< just after the event
    std::vector<PathChange> changes; ///< all nodes that change at this event
    bool   jump     = false; ///< to another equilibrium at the same load
    bool   plateau  = false; ///< reached by a finite motion at constant load
    bool   turn     = false; ///< the parameter turns here
    int    way      = 1;     ///< of the parameter just after: 1 grows, -1 falls
    double residual = 0;     ///< path_residual() against the point before it
  };

  enum class PathOutcome
  {
    target_reached,    ///< the stage's end
    no_further_change, ///< the end, and the states stay for all larger p
    limit_load,        ///< a mechanism: `mechanism` is its velocity
    turning_point,     ///< the stage starts with loads that cannot grow
    returned_to_start, ///< after a turning point p has fallen to the stage's
                       ///< begin
    cycle,             ///< the path comes again to a piece it has followed
    no_equilibrium,    ///< incremental law: a jump, and nowhere to land
    not_converged
  };

  struct PathResult
  {
    PathOutcome     outcome   = PathOutcome::not_converged;
    double          parameter = 0; ///< where the path ends
    Eigen::VectorXd mechanism;     ///< rate of v, largest entry 1; limit load
    std::string     reason;        ///< a sentence, or nothing
  };

  /** Takes each point as soon as it is known. */
  using PathVisitor = std::function<void(const PathPoint &)>;

  /**
   * Follows a load parameter through every change of contact state, [P], one
   * stage after the other; slips are remembered between stages.
   *
   * With much friction a path may turn: no state next to a point balances a
   * larger load. Under the holonomic law it then is a chain of linear pieces on
   * which p falls, and grows again. Coulomb's law is one of time, in which
   * loads go on: the bodies jump to another equilibrium under the same load.
   */
  class PathFollower
  {
  public:
    virtual ~PathFollower() = default;
    virtual PathResult
    follow(const PathStage &stage, const PathVisitor &visit) = 0;
  };

  /**
   * The measure of a point of a path, free of units and outside the follower:
   * the larger of the residual of the linear relation and of
   * @f$ g \ge 0 \perp r_n \ge 0 @f$ and the friction law on the displacement
   * since `before` (holonomic: since the start), as in contact_residual() but
   * with cohesion. Cohesion acts on open nodes too, as in [P].
   */
  double
  path_residual(const solvers::ContactSystem &system,
                const PathOptions            &options,
                const Eigen::VectorXd        &load,
                const PathPoint              &before,
                const PathPoint              &point);

  /**
   * The exact follower of 2D problems (at most one tangent a node), event by
   * event; stiffness form, K may be singular. `gap` is g at the start. Throws
   * std::invalid_argument for other problems, and for a stage that does not
   * start where the one before it ended.
   */
  std::unique_ptr<PathFollower>
  make_event_follower(std::shared_ptr<const solvers::ContactSystem> system,
                      const Eigen::VectorXd                        &gap,
                      const PathOptions                            &options);

  /**
   * The follower of 3D problems: increments of the SOCLCP, changes of state
   * bracketed by bisection to 1e-8 of the stage. Incremental law, no cohesion.
   */
  std::unique_ptr<PathFollower>
  make_bracketing_follower(std::shared_ptr<const solvers::ContactSystem> system,
                           const Eigen::VectorXd                        &gap,
                           const PathOptions &options);
} // namespace conetact::load_path

#endif
