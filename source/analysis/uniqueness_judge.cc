// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/uniqueness_judge.h"

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

    std::string
    bound(const std::optional<double> &factor, const Eigen::VectorXd &mu)
    {
      if (factor)
        return "uniqueness is " + up_to(*factor, mu);
      return "there is no bound for bodies that float, for contacts that are "
             "redundant and for more than " +
             std::to_string(solvers::UniquenessCheck::most) + " unknowns";
    }
  } // namespace

  UniquenessJudge::UniquenessJudge(RunContext &r, const bool change)
    : run(r)
    , contacts_change(change)
  {}

  const solvers::UniquenessCheck &
  UniquenessJudge::check_of(
    const std::shared_ptr<const solvers::ContactSystem> &cones)
  {
    if (!check || contacts_change || check->mu().size() != cones->mu.size() ||
        check->mu() != cones->mu)
      check.emplace(cones);
    return *check;
  }

  void
  UniquenessJudge::judge(PendingIncrement              &increment,
                         const solvers::ContactProblem &problem)
  {
    const auto tell = [&](const std::string &verdict, const std::string &why) {
      increment.record.unique = verdict;
      run.log.note("increment " + std::to_string(increment.record.increment) +
                   ": " + why);
    };
    increment.another.reset();
    if (!problem.has_cones() || problem.has_layers())
      return tell("open",
                  "whether the solution is unique is open: its laws are not "
                  "those of cones");
    const solvers::ContactProblem cones =
      solvers::with_coefficients_of(increment.end, problem);
    const Eigen::VectorXd      &mu     = cones.system->mu;
    const std::optional<double> factor = check_of(cones.system).proof_factor();
    if (factor && *factor >= 1)
      return tell("yes", "the solution is unique, " + up_to(*factor, mu));
    auto found =
      solvers::find_another(cones, increment.end, run.scene.solver.tolerance);
    if (found.is_complete)
      return tell("yes",
                  "the solution is unique: of " +
                    std::to_string(found.n_tried) +
                    " sets of states no other one has one; for all loads " +
                    bound(factor, mu));
    if (!found.other)
      return tell("open",
                  "whether the solution is unique is open: " +
                    bound(factor, mu) + ", and no other solution was found");
    tell("no",
         "the solution is not unique: reactions-2.csv has another one; " +
           bound(factor, mu));
    increment.another = std::make_shared<const AnotherSolution>(
      AnotherSolution{problem, std::move(*found.other)});
  }
} // namespace conetact::analysis
