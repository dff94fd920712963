// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Positions that contacts leave open at the end of an increment.

#include "conetact/analysis/increment_analysis.h"

namespace conetact::analysis
{
  contact::OpenMotions
  IncrementAnalysis::open_motions(const PendingIncrement &increment) const
  {
    return {model.motions,
            model.points,
            increment.state,
            history.largest_force(),
            increment.load.laws.get()};
  }

  /* Any end that open motions lead to is a solution; the shortest way is what
     is promised. */
  void
  IncrementAnalysis::shorten_way(PendingIncrement              &increment,
                                 const solvers::ContactProblem &problem)
  {
    const contact::OpenMotions open = open_motions(increment);
    if (!open.exist())
      return;
    const contact::Coordinates &coordinates = model.coordinates;
    const Eigen::VectorXd       w =
      model.elasticity().expand({&increment.load}, {increment.primal});
    Eigen::VectorXd way =
      coordinates.in_frames(acceptance.displacements(increment, w));
    const Eigen::VectorXd &start = acceptance.accepted_displacements();
    way -= coordinates.in_frames(
      start.size() > 0 ? start : Eigen::VectorXd::Zero(way.size()).eval());
    const Eigen::VectorXd change = open.shortening(way);
    if (change.size() == 0)
      return;
    const double largest = history.largest_force();
    history              = increment.before;
    history.linearise_at(increment.base);
    history.move(increment.end, change, largest);
    take_result(increment, problem);
  }

  /* Where all contacts are bound, foundations alone hold what floats. */
  void
  IncrementAnalysis::solve_motions(const solvers::ContactProblem &problem,
                                   solvers::ContactState         &state,
                                   solvers::SolverReport         &report)
  {
    state.r = -problem.system->matrix.fullPivLu().solve(problem.load);
    // what they do not resist, such as a ring's spin, stays as it is
    const Eigen::MatrixXd &loose = model.motions.unresisted();
    state.r -= loose * (loose.transpose() * state.r);
    state.v           = Eigen::VectorXd::Zero(state.r.size());
    report.converged  = true;
    report.solver     = "linear";
    report.iterations = report.factorizations = 1;
  }
} // namespace conetact::analysis
