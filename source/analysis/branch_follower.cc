// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/branch_follower.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/solvers/all_solutions.h"

#include <algorithm>
#include <utility>

namespace conetact::analysis
{
  namespace
  {
    /** Of displacements and reactions, over the largest of each; ways that are
     * nothing beside an edge are none. */
    bool
    are_the_same(const contact::ContactHistory &one,
                 const solvers::ContactState   &end_of_one,
                 const contact::ContactHistory &other,
                 const solvers::ContactState   &end_of_other,
                 const double                   edge)
    {
      constexpr double same = 1e-7, nothing = 1e-9;
      const auto near = [](const auto &a, const auto &b, const double least) {
        return solvers::largest(a - b) <=
               same * std::max(solvers::largest(a), least);
      };
      return near(one.displacements(), other.displacements(), nothing * edge) &&
             near(end_of_one.r, end_of_other.r, 0.);
    }

    double
    longest_edge(const contact::ContactPoints &points)
    {
      double edge = 0;
      for (const contact::ContactPoint &point : points)
        edge = std::max(edge, point.node->spacing);
      return edge;
    }
  } // namespace

  BranchFollower::BranchFollower(RunContext &r, const bool contacts_change)
    : run(r)
  {
    if (!run.scene.follows_branches)
      return;
    const std::string in = "Solver, Method = all solutions: ";
    if (run.model.bodies.dim == 3)
      throw InputError(in + "in space slips have any direction, and solutions "
                            "are no finite number of linear problems. Choose "
                            "automatic.");
    if (!run.model.motions.loose().empty())
      throw InputError(in + "bodies must be held by supports or foundations, "
                            "and one of these is not. Add a Support, or "
                            "choose automatic.");
    if (contact::has_nodal_laws(run.model.points))
      throw InputError(in + "friction must be one coefficient of x, y, z, "
                            "without Cohesion, Compliance, wear, fluid, Active "
                            "and springs. Choose automatic.");
    if (contacts_change)
      throw InputError(in + "contacts are found anew as bodies move, which "
                            "they do by Kinematics = finite sliding, or by "
                            "automatic where motions are large. Set Kinematics "
                            "= small in each Contact, or choose automatic.");
  }

  void
  BranchFollower::add(const Branch                  &from,
                      const solvers::ContactProblem &problem,
                      const solvers::ContactState   &end,
                      const PendingIncrement        &increment,
                      std::vector<Branch>           &next) const
  {
    const double edge = longest_edge(run.model.points);
    Branch       branch{from.after, from.after, {problem, end}, 0, from.number};
    branch.after.advance(end, increment.record.time);
    for (const Branch &other : next)
      if (are_the_same(
            branch.after, end, other.after, other.solution.end, edge))
        return;
    branch.number = static_cast<unsigned int>(next.size()) + 1;
    next.push_back(std::move(branch));
  }

  void
  BranchFollower::say(const std::vector<Branch> &next,
                      const PendingIncrement    &increment,
                      const std::string         &open) const
  {
    constexpr std::size_t most = 200;
    const std::string     k    = std::to_string(increment.record.increment);
    if (next.size() > most)
      throw AnalysisError(
        "Increment " + k + " has " + std::to_string(next.size()) +
        " solutions, too many to follow. Take fewer increments, or a smaller "
        "coefficient of friction");
    run.log.note("increment " + k + ": " + std::to_string(next.size()) +
                 (next.size() == 1 ? " solution" : " solutions") +
                 (open.empty() ? "" : ", and there may be others: " + open));
  }

  void
  BranchFollower::follow(const PendingIncrement        &increment,
                         const solvers::ContactProblem &problem)
  {
    std::vector<Branch> next;
    std::string         open;
    if (branches.empty())
      branches.push_back({increment.before, increment.before, {}, 1, 1});
    // an increment that is corrected is followed once more
    if (std::exchange(number, increment.record.increment) != number)
      starts = branches;
    starts.front().after = increment.before;
    add(starts.front(), problem, increment.end, increment, next);
    for (Branch &from : starts)
      {
        const solvers::ContactProblem own =
          from.number == 1 ? problem : from.after.problem(increment.load);
        const solvers::AllSolutions all =
          solvers::find_all_solutions(own, run.scene.solver.tolerance);
        open = open.empty() ? all.open : open;
        for (const solvers::ContactState &end : all.found)
          add(from, own, end, increment, next);
      }
    say(next, increment, open);
    branches = std::move(next);
  }
} // namespace conetact::analysis
