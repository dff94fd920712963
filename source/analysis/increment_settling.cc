// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contacts that slide far, found again until an increment ends with those that
// it was solved with.

#include "conetact/analysis/cost.h"
#include "conetact/analysis/increment_analysis.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace conetact::analysis
{
  std::string
  IncrementAnalysis::take(ContactSearch::Found found)
  {
    if (std::string why = search.take(std::move(found), history); !why.empty())
      return why;
    acceptance.relink();
    existence.reset();
    if (const std::string why = model.why_not(); !why.empty())
      {
        if (!fits_condensed(model, scene.times.size(), scene.n_drawings()))
          return "Contacts have slid to where Backend = iterative " + why +
                 ", and condensed bodies take more memory than this machine "
                 "has.";
        condense_from_here("Contacts have slid to where Backend = iterative " +
                           why + ".");
      }
    return {};
  }

  void
  IncrementAnalysis::must_take(ContactSearch::Found found)
  {
    if (const std::string why = take(std::move(found)); !why.empty())
      throw AnalysisError(why);
  }

  std::string
  IncrementAnalysis::solve_with(ContactSearch::Found found,
                                PendingIncrement    &increment)
  {
    const Eigen::VectorXd w = model.elasticity().deformation(increment.primal);
    const Eigen::VectorXd motions = increment.motions;
    history                       = increment.before;
    if (std::string lost = take(std::move(found)); !lost.empty())
      {
        if (lost.back() == '.') // the sentence goes on
          lost.pop_back();
        return lost;
      }
    increment.before = history;
    apply_loads(increment);
    solvers::ContactState guess = history.start();
    guess.node                  = increment.end.node;
    guess.nearby                = history.nearby(w, motions);
    const unsigned int before   = increment.record.report.iterations;
    const std::string  why      = solve_contact(increment, guess);
    increment.record.report.iterations += before;
    return why;
  }

  std::string
  IncrementAnalysis::settle(PendingIncrement &increment)
  {
    constexpr unsigned int most       = 30;
    constexpr double       exact      = 1e-9;
    constexpr double       least_turn = 1e-3; // where the rest is not exact
    constexpr double       strain = 1e-4; // what false ones are compared with
    double                 before = std::numeric_limits<double>::max();
    unsigned int           n_slow = 1;
    for (unsigned int &n = increment.record.pairings;;)
      {
        const Eigen::VectorXd w =
          model.elasticity().expand({&increment.load}, {increment.primal});
        const Eigen::VectorXd u = acceptance.displacements(increment, w);
        ContactSearch::Found  found =
          search.find(u, increment.record.time, n_slow > 1);
        if (!found.why_not.empty())
          return found.why_not;
        const ContactSearch::Change change =
          search.change(increment, u, found.nodes);
        const Eigen::VectorXd moved =
          acceptance.amounts(increment) +
          model.motions.of_free(model.motions.free_in(w));
        // cos a - 1 is what a small rotation by a strains its body
        const double angle   = model.frames.turn(moved);
        const double turn    = .5 * angle * angle / strain;
        const double error   = std::max({change.gap, change.force, turn});
        const bool   is_slow = n >= most / 3 && error > .9 * before;
        before               = error;
        if (error <= exact)
          return passes_through(increment.record, u);
        if ((is_slow || n == most) && turn <= least_turn &&
            may_take(increment.record, change))
          {
            say_unsettled(increment.record, change);
            return passes_through(increment.record, u);
          }
        if (n++ == most)
          return why_unsettled(change, turn) +
                 "; Kinematics = small keeps the contacts of the start, with a "
                 "warning where they are wrong";
        model.frames.move(moved);
        if (is_slow || n_slow > 1) // from now on
          found = search.find_between(u, increment.record.time, 1. / ++n_slow);
        if (const std::string why = solve_with(std::move(found), increment);
            !why.empty())
          return why;
      }
  }

  std::string
  IncrementAnalysis::why_unsettled(const ContactSearch::Change &change,
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
  IncrementAnalysis::where(const pairing::ContactNode *node) const
  {
    return node == nullptr ?
             "" :
             ", most of all at the node " + to_text(node->position) + " of " +
               model.bodies.called(node->body) +
               ", which may have come to an edge or to the end of a surface";
  }

  bool
  IncrementAnalysis::may_take(const output::IncrementRecord &record,
                              const pairing::FoundChange    &change) const
  {
    constexpr double enough = 1e-3; // where facets meet there is no more
    constexpr double nearly = 1e-2; // of directions
    return change.gap <= enough &&
           (change.force <= nearly ||
            !parts.is_long(search.time(),
                           duration(record.increment),
                           scene.times[record.increment - 1]));
  }

  /* A body that goes round an edge may look so: it is asked for smaller parts
     only. */
  std::string
  IncrementAnalysis::passes_through(const output::IncrementRecord &record,
                                    const Eigen::VectorXd         &u)
  {
    const bool        may_be_cut = parts.may_be_cut(search.time(),
                                             duration(record.increment),
                                             scene.times[record.increment - 1]);
    const std::string why = search.passes_through(u, record.time, may_be_cut);
    return why.empty() && may_be_cut ? search.loses_masters(u) : why;
  }

  double
  IncrementAnalysis::duration(const unsigned int k) const
  {
    AssertIndexRange(k - 1, scene.times.size());
    return scene.times[k - 1] - begin(k);
  }

  void
  IncrementAnalysis::say_unsettled(const output::IncrementRecord &record,
                                   const pairing::FoundChange    &change)
  {
    const std::string sentence =
      name(record) + " (t = " + to_text(record.time) +
      "): contacts that slide are found elsewhere again and again, as where "
      "facets meet. Those taken are off by " +
      to_text(change.gap) + " of a cell in their gaps, by " +
      to_text(change.force) + " of the largest reaction in their directions";
    if (said_unsettled)
      log.note(sentence);
    else
      log.say("warning: " + sentence +
              ". Use smoother surfaces or Pairing = mortar, or smaller "
              "increments; others are told in log.txt.");
    said_unsettled = true;
  }

  bool
  IncrementAnalysis::cut(const unsigned int k)
  {
    const double whole    = scene.times[k - 1];
    const bool   has_laws = contact::has_nodal_laws(model.points);
    if (!lost_contacts && !(unsolved && has_laws))
      return false;
    const double begin =
      lost_contacts ? search.time() : acceptance.accepted_time();
    if (!parts.cut(begin, duration(k), whole))
      return false;
    log.note("increment " + std::to_string(k) +
             (lost_contacts ? ": contacts that slide are not found" :
                              ": its laws of contact do not settle") +
             ", it is cut: a part up to t = " + to_text(parts.end(whole)));
    return true;
  }
} // namespace conetact::analysis
