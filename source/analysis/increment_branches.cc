// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Method = all solutions: every solution of each increment, from every one of
// the increment before.

#include "conetact/analysis/increment_analysis.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/solvers/all_solutions.h"

#include <algorithm>

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

  void
  IncrementAnalysis::check_branches() const
  {
    if (!scene.follows_branches)
      return;
    const std::string in = "Solver, Method = all solutions: ";
    if (model.bodies.dim == 3)
      throw InputError(in + "in space slips have any direction, and solutions "
                            "are no finite number of linear problems. Choose "
                            "automatic.");
    if (model.motions.n_free() > 0)
      throw InputError(in + "bodies must be held by supports or foundations, "
                            "and one of these is not. Add a Support, or "
                            "choose automatic.");
    if (contact::has_nodal_laws(model.points) || search.is_needed())
      throw InputError(in + "friction must be one coefficient of x, y, z, "
                            "without Cohesion, Compliance, wear, fluid, Active "
                            "and springs, and Kinematics small. Choose "
                            "automatic.");
  }

  /* The first branch is the one that is verified and goes on as the run. */
  void
  IncrementAnalysis::follow_branches(PendingIncrement              &increment,
                                     const solvers::ContactProblem &problem)
  {
    constexpr std::size_t most = 200;
    const double          edge = longest_edge(model.points);
    std::vector<Branch>   next;
    std::string           open;
    const auto            add = [&](Branch                        &from,
                         const solvers::ContactProblem &of,
                         const solvers::ContactState   &end) {
      Branch branch{from.after, from.after, {of, end}, 0, from.number};
      branch.after.advance(end, increment.record.time);
      for (const Branch &other : next)
        if (are_the_same(
              branch.after, end, other.after, other.solution.end, edge))
          return;
      branch.number = static_cast<unsigned int>(next.size()) + 1;
      next.push_back(std::move(branch));
    };
    if (branches.empty())
      branches.push_back({increment.before, increment.before, {}, 1, 1});
    branches.front().after = increment.before; // as it was corrected
    add(branches.front(), problem, increment.end);
    for (Branch &from : branches)
      {
        const solvers::ContactProblem own =
          from.number == 1 ? problem : from.after.problem(increment.load);
        const solvers::AllSolutions all =
          solvers::find_all_solutions(own, scene.solver.tolerance);
        open = open.empty() ? all.open : open;
        for (const solvers::ContactState &end : all.found)
          add(from, own, end);
      }
    if (next.size() > most)
      throw AnalysisError(
        "Increment " + std::to_string(increment.record.increment) + " has " +
        std::to_string(next.size()) +
        " solutions, too many to follow. Take fewer increments, or a smaller "
        "coefficient of friction");
    log.note("increment " + std::to_string(increment.record.increment) + ": " +
             std::to_string(next.size()) +
             (next.size() == 1 ? " solution" : " solutions") +
             (open.empty() ? "" : ", and there may be others: " + open));
    branches = std::move(next);
  }

  std::vector<output::BranchRows>
  IncrementAnalysis::rows_of_branches(const PendingIncrement &increment)
  {
    std::vector<output::BranchRows> all;
    for (const Branch &branch : branches)
      all.push_back(
        {branch.number,
         branch.parent,
         rows_of_solution(increment, branch.before, branch.solution)});
    return all;
  }
} // namespace conetact::analysis
