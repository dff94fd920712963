// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether increments have one solution.

#include "conetact/analysis/increment_analysis.h"
#include "conetact/base/text.h"

#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    /** Of which a bound is told: the largest coefficient of all nodes. */
    std::string
    up_to(const double factor, const Eigen::VectorXd &mu)
    {
      if (std::isinf(factor))
        return "there is no friction";
      return "proved up to a coefficient of friction of " +
             to_text(factor * mu.maxCoeff());
    }
  } // namespace

  void
  IncrementAnalysis::judge_uniqueness(PendingIncrement              &increment,
                                      const solvers::ContactProblem &problem)
  {
    const std::string when =
      "increment " + std::to_string(increment.record.increment) + ": ";
    const auto tell = [&](const std::string &verdict, const std::string &why) {
      increment.record.unique = verdict;
      log.note(when + why);
    };
    increment.another.reset();
    const bool varies = !problem.has_cones() || problem.has_layers();
    if (varies)
      return tell("open",
                  "whether the solution is unique is open: its laws are not "
                  "those of cones");
    const solvers::ContactProblem cones =
      solvers::with_coefficients_of(increment.end, problem);
    const Eigen::VectorXd &mu = cones.system->mu;
    if (!uniqueness || uniqueness->mu().size() != mu.size() ||
        uniqueness->mu() != mu || search.is_needed())
      uniqueness.emplace(cones.system);
    const std::optional<double> factor = uniqueness->proof_factor();
    if (factor && *factor >= 1)
      return tell("yes", "the solution is unique, " + up_to(*factor, mu));
    const std::string bound =
      factor ? "uniqueness is " + up_to(*factor, mu) :
               "there is no bound for bodies that float, for contacts that are "
               "redundant and for more than " +
                 std::to_string(solvers::UniquenessCheck::most) + " unknowns";
    auto found =
      solvers::find_another(cones, increment.end, scene.solver.tolerance);
    if (found.is_complete)
      return tell("yes",
                  "the solution is unique: of " +
                    std::to_string(found.n_tried) +
                    " sets of states no other one has one; for all loads " +
                    bound);
    if (!found.other)
      return tell("open",
                  "whether the solution is unique is open: " + bound +
                    ", and no other solution was found");
    tell("no",
         "the solution is not unique: reactions-2.csv has another one; " +
           bound);
    increment.another = std::make_shared<const AnotherSolution>(
      AnotherSolution{problem, std::move(*found.other)});
  }

  std::vector<output::ContactRow>
  IncrementAnalysis::rows_of_solution(const PendingIncrement        &increment,
                                      const contact::ContactHistory &before,
                                      const AnotherSolution         &solution)
  {
    const contact::ContactHistory now   = history;
    PendingIncrement              other = increment;
    history = other.before = before;
    history.linearise_at(increment.base);
    other.end = solution.end;
    take_result(other, solution.problem);
    history = now;
    const Eigen::VectorXd w =
      model.elasticity().expand({&other.load}, {other.primal});
    return acceptance.rows_of(other, w);
  }
} // namespace conetact::analysis
