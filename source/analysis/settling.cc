// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/settling.h"

#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace conetact::analysis
{
  Settling::Settling(RunContext           &r,
                     IncrementSolver      &of_increments,
                     const IncrementParts &of_increment,
                     Swinging             &of_bodies)
    : run(r)
    , solver(of_increments)
    , parts(of_increment)
    , swinging(of_bodies)
  {}

  Failure
  Settling::settle(PendingIncrement &increment)
  {
    constexpr unsigned int most           = 30;
    constexpr double       exact          = 1e-9;
    constexpr double       least_turn     = 1e-3; // where the rest is not exact
    constexpr double       nearly_settled = 1e-2;
    constexpr double       strain = 1e-4; // what false ones are compared with
    double                 before = std::numeric_limits<double>::max();
    unsigned int           n_slow = 1;
    for (unsigned int &n = increment.record.pairings;;)
      {
        const Eigen::VectorXd w =
          run.model.elasticity()
            .expand({&increment.load}, {increment.primal})
            .front();
        const Eigen::VectorXd u = run.acceptance.displacements(increment, w);
        ContactSearch::Found  found =
          solver.search.find(u, increment.record.time, n_slow > 1);
        if (!found.why_not.empty())
          return {found.why_not, false, true};
        const ContactSearch::Change change =
          solver.search.change(increment, u, found.nodes);
        const Eigen::VectorXd moved =
          run.acceptance.amounts(increment) +
          run.model.motions.of_free(run.model.motions.free_in(w));
        // cos a - 1 is what a small rotation by a strains its body
        const double angle   = run.model.frames.turn(moved);
        const double turn    = .5 * angle * angle / strain;
        const double error   = std::max({change.gap, change.force, turn});
        const bool   is_slow = n >= most / 3 && error > .9 * before;
        before               = error;
        if (error <= exact && swinging.is_over(increment))
          return passes_through(increment.record, u);
        if ((is_slow || n == most) && turn <= least_turn &&
            swinging.is_over(increment) && may_take(increment.record, change))
          {
            say_unsettled(increment.record, change);
            return passes_through(increment.record, u);
          }
        if (n++ == most)
          return {why_unsettled(change, turn) +
                    "; Kinematics = small keeps the contacts of the start, "
                    "with a warning where they are wrong",
                  false,
                  true};
        if (swinging.is_on())
          swinging.go_on(increment, w);
        run.model.frames.move(moved);
        if (const std::string why = solver.search.rolls_on(); !why.empty())
          return {why, false, true};
        n_slow += is_slow;
        if (n_slow > 1) // from now on
          found =
            solver.search.find_between(u,
                                       increment.record.time,
                                       error < nearly_settled ? 1. :
                                                                1. / n_slow);
        if (const Failure failure =
              solver.solve_with(std::move(found), increment))
          return {failure.why, failure.unsolved, true};
      }
  }

  std::string
  Settling::why_unsettled(const ContactSearch::Change &change,
                          const double                 turn) const
  {
    if (turn > std::max(change.gap, change.force))
      return "how far bodies turn is found otherwise again and again, as where "
             "they deform so much that small strains are wrong. Use smaller "
             "loads or stiffer bodies";
    return "contacts that slide are found elsewhere again and again, their "
           "gaps are off by " +
           to_text(change.gap) + " of a cell, also in parts of the increment" +
           where(change.worst) +
           ". Use smaller increments or smoother surfaces";
  }

  /* Where a surface ends, what slides off it has no neighbour to be found on.
   */
  std::string
  Settling::where(const pairing::ContactNode *node) const
  {
    return node == nullptr ?
             "" :
             ", most of all at the node " + to_text(node->position) + " of " +
               run.model.bodies.called(node->body) +
               ", which may have come to an edge or to the end of a surface";
  }

  bool
  Settling::may_take(const model::IncrementRecord &record,
                     const pairing::FoundChange   &change) const
  {
    constexpr double enough = 1e-3; // where facets meet there is no more
    constexpr double nearly = 1e-2; // of directions
    return change.gap <= enough &&
           (change.force <= nearly ||
            !parts.is_long(solver.search.time(),
                           run.duration(record.increment),
                           run.scene.times[record.increment - 1]));
  }

  /* A body that goes round an edge may look so: it is asked for smaller parts
     only. */
  Failure
  Settling::passes_through(const model::IncrementRecord &record,
                           const Eigen::VectorXd        &u)
  {
    const bool may_be_cut =
      parts.may_be_cut(solver.search.time(),
                       run.duration(record.increment),
                       run.scene.times[record.increment - 1]);
    const std::string why =
      solver.search.passes_through(u, record.time, may_be_cut);
    return {why.empty() && may_be_cut ?
              solver.search.loses_masters(u, record.time) :
              why,
            false,
            true};
  }

  void
  Settling::say_unsettled(const model::IncrementRecord &record,
                          const pairing::FoundChange   &change)
  {
    constexpr double  worth_a_word = 1e-6;
    const std::string sentence =
      run.increment_name(record) + " (t = " + to_text(record.time) +
      "): contacts that slide are found elsewhere again and again, as where "
      "facets meet. Those taken are off by " +
      to_text(change.gap) + " of a cell in their gaps, by " +
      to_text(change.force) + " of the largest reaction in their directions";
    if (has_said || std::max(change.gap, change.force) < worth_a_word)
      {
        run.log.note(sentence);
        return;
      }
    run.log.say("warning: " + sentence +
                ". Use smoother surfaces or Pairing = mortar, or smaller "
                "increments; others are told in log.txt.");
    has_said = true;
  }
} // namespace conetact::analysis
