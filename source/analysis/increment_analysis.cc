// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/increment_analysis.h"

#include "conetact/analysis/askew_contacts.h"
#include "conetact/analysis/cost.h"
#include "conetact/analysis/scene_report.h"
#include "conetact/base/errors.h"
#include "conetact/base/interruption.h"
#include "conetact/base/process.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <utility>

namespace conetact::analysis
{
  namespace
  {
    double
    error_of(const verification::Finding &finding)
    {
      return std::max(finding.residual, finding.equilibrium);
    }

    /** A share of the load of a part is none of the whole increment. */
    std::string
    of_part(std::string why, const double begin)
    {
      const std::string part = "of the load of this part of the increment";
      const std::pair<std::string, std::string> words[] = {
        {"of this increment's load",
         part + ", from t = " + to_text(begin) + " on,"},
        {"of the load of this increment", part}};
      for (const auto &[whole, instead] : words)
        if (const std::size_t at = why.find(whole); at != std::string::npos)
          why.replace(at, whole.size(), instead);
      return why;
    }

    /** Of what processes have found, on which decisions rest; throws
     * AnalysisError. */
    void
    demand_equal(const std::vector<PendingIncrement> &batch,
                 const std::vector<Eigen::VectorXd>  &w)
    {
      std::vector<std::pair<const double *, Eigen::Index>> numbers;
      for (const Eigen::VectorXd &x : w)
        numbers.emplace_back(x.data(), x.size());
      for (const PendingIncrement &increment : batch)
        for (const Eigen::VectorXd *x : {&increment.end.v, &increment.end.r})
          numbers.emplace_back(x->data(), x->size());
      conetact::demand_equal(numbers);
    }
  } // namespace

  IncrementAnalysis::IncrementAnalysis(const application::Scene &s, Log &l)
    : Analysis(s, l)
    , solver(*this)
    , swinging(*this)
    , settling(*this, solver, parts, swinging)
    , between(solver.search.sliding_contacts(), model)
    , wear(*this, solver.search.is_needed())
  {
    if (scene.restart)
      restore_state();
  }

  void
  IncrementAnalysis::check_history()
  {
    Analysis::check_history();
    PendingIncrement first{history, history};
    first.record.time = scene.times[scene.n_done()];
    set_laws(first);
  }

  void
  IncrementAnalysis::run(const std::filesystem::path &folder, const bool quiet)
  {
    using Outcome = Step::Outcome;
    create_outputs(folder, scene.times.size(), quiet);
    for (unsigned int next = scene.n_done() + 1; next <= scene.times.size();)
      {
        std::vector<PendingIncrement> batch;
        const Step                    solved = solve_batch(next, batch);
        Step                          step   = finish(batch);
        save_state(step.outcome == Outcome::failed ||
                   solved.outcome == Outcome::failed);
        if (n_on_disk > 0) // for a process that is ended without being asked
          Interruption::know(interrupted());
        if (step.outcome == Outcome::accepted)
          step = solved;
        next = step.next;
        switch (step.outcome)
          {
            case Outcome::accepted:
              stop_if_asked(next);
              break;
            case Outcome::corrected:
              one_by_one = true;
              stop_if_asked(next);
              break;
            case Outcome::failed:
              if (!leaves_small().empty())
                return;
              if (wants_to_stop())
                stop();
              go_on_otherwise(next, step.failure);
              if (!is_in_team()) // the first process goes on alone
                return;
          }
      }
    report_skips(scene, model, loads, log);
    wear.error.report(scene.contact_names, log);
  }

  std::size_t
  IncrementAnalysis::batch_size(const unsigned int n_finished) const
  {
    if (one_by_one || scene.follows_branches || solver.search.is_needed() ||
        !backend->batches || contact::has_nodal_laws(model.points))
      return 1;
    std::size_t most = most_at_once();
    if (const unsigned int every = scene.checkpoint_every; every > 0)
      most = std::min<std::size_t>(most, every - n_finished % every);
    return most;
  }

  IncrementAnalysis::Step
  IncrementAnalysis::solve_batch(const unsigned int             first,
                                 std::vector<PendingIncrement> &batch)
  {
    const std::size_t size = batch_size(first - 1);
    unsigned int      k    = first;
    if (lock_is_due(k))
      lock(k);
    const auto is_full = [&] {
      return batch.size() >= size || (!batch.empty() && wants_to_stop());
    };
    for (; k <= scene.times.size() && !is_full() && !lock_is_due(k); ++k)
      {
        solver.set_start_known(batch.empty());
        batch.push_back(solver.start(k, parts.end(scene.times[k - 1])));
        PendingIncrement &increment = batch.back();
        Failure           failure   = solve_next(increment);
        if (failure)
          failure.why =
            failed(increment.record,
                   parts.is_cut() ?
                     of_part(failure.why, acceptance.accepted_time()) :
                     failure.why);
        // how long the way of an open motion is says the end of the one before
        const bool is_early = !failure && batch.size() > 1 &&
                              solver.open_motions(increment).exist();
        if (!failure && !is_early)
          continue;
        history = increment.before;
        batch.pop_back();
        one_by_one = one_by_one || is_early;
        if (is_early || failure.is_postponed)
          break;
        return {Step::Outcome::failed, k, failure};
      }
    return {Step::Outcome::accepted, parts.others_follow() ? first : k};
  }

  /* What the fast method does not find where a body may hang is tried with the
     body swinging before slow methods are; and what swings by itself if it
     comes to no end otherwise. */
  Failure
  IncrementAnalysis::solve_next(PendingIncrement &increment)
  {
    const bool swings = swinging.is_on();
    const bool may_swing =
      !swings && swinging.may_help(increment) && backend->otherwise == nullptr;
    solver.set_fast_only(may_swing);
    const Failure failure = solve_and_settle(increment);
    if (!failure || (!swings && !may_swing))
      return once_condensed(failure, increment);
    const bool was_left = solver.was_slow();
    solver.set_fast_only(false);
    const auto try_again = [&] {
      history = increment.before;
      increment =
        solver.start(increment.record.increment, increment.record.time);
      return solve_and_settle(increment);
    };
    if (may_swing)
      {
        swinging.begin(increment);
        if (!try_again())
          return {};
      }
    swinging.stop();
    return swings || was_left ? try_again() : failure;
  }

  /* Bodies swing where they are condensed. */
  Failure
  IncrementAnalysis::once_condensed(Failure                 failure,
                                    const PendingIncrement &increment) const
  {
    failure.unsolved =
      failure.unsolved || (failure && backend->otherwise != nullptr &&
                           swinging.may_help(increment));
    return failure;
  }

  Failure
  IncrementAnalysis::solve_and_settle(PendingIncrement &increment)
  {
    const Failure failure = solver.solve(increment);
    return !failure && solver.search.is_needed() ? settling.settle(increment) :
                                                   failure;
  }

  bool
  IncrementAnalysis::lock_is_due(const unsigned int k) const
  {
    const auto &cuts = model.bodies.cuts;
    return std::any_of(cuts.begin(), cuts.end(), [&](const model::Cut &cut) {
      return !cut.opening && cut.is_due(begin(k));
    });
  }

  void
  IncrementAnalysis::lock(const unsigned int k)
  {
    // Solvers hold what they have last solved, which may be a system of all
    // unknowns: it goes before there is another one.
    solver.forget();
    history.lock_cuts(begin(k), acceptance.accepted_displacements());
    log.note("increment " + std::to_string(k) + ": preloads are locked");
  }

  std::vector<Eigen::VectorXd>
  IncrementAnalysis::deformations(const std::vector<PendingIncrement> &batch)
  {
    std::vector<const contact::LoadCase *> cases;
    std::vector<Eigen::VectorXd>           primal;
    for (const PendingIncrement &increment : batch)
      {
        cases.push_back(&increment.load);
        primal.push_back(increment.primal);
      }
    acceptance.set_stiffness(model.elasticity());
    std::vector<Eigen::VectorXd> w = model.elasticity().expand(cases, primal);
    demand_equal(batch, w);
    return w;
  }

  IncrementAnalysis::Step
  IncrementAnalysis::finish(std::vector<PendingIncrement> &batch)
  {
    AssertIndexRange(batch.size(), scene.times.size() + 1);
    using Outcome = Step::Outcome;
    solver.set_start_known(true);
    if (batch.empty())
      return {};
    give_back_memory(); // of solvers, before there are vectors of all dofs
    std::vector<Eigen::VectorXd>        w = deformations(batch);
    std::vector<model::IncrementRecord> finished;
    Step                                step;
    for (std::size_t i = 0;
         i < batch.size() && step.outcome == Outcome::accepted;
         ++i)
      {
        step = check(batch[i], contact::shared(std::move(w[i])));
        const bool has_failed = step.outcome == Outcome::failed;
        history               = has_failed ? batch[i].before : batch[i].after;
        if (!has_failed)
          keep(batch[i], finished);
      }
    write(finished);
    for (const model::IncrementRecord &record : finished)
      n_reaction_rows += record.rows.size();
    return step;
  }

  void
  IncrementAnalysis::keep(PendingIncrement                    &increment,
                          std::vector<model::IncrementRecord> &finished)
  {
    solver.fluid.say_leaks(increment);
    wear.add(increment);
    if (parts.take(increment.record))
      finished.push_back(std::move(increment.record));
  }

  IncrementAnalysis::Step
  IncrementAnalysis::check(PendingIncrement &increment, contact::SharedVector w)
  {
    AssertDimension(w->size(), model.coordinates.n_dofs());
    verification::Finding finding      = acceptance.judge(increment, w);
    const bool            is_corrected = correct(increment, finding, w);
    const unsigned int    k            = increment.record.increment;
    solver.add_other_solutions(increment);
    if (const std::string why = complete(increment, finding, w); !why.empty())
      {
        const bool is_exact = error_of(finding) <= scene.solver.tolerance;
        return {Step::Outcome::failed,
                k,
                {failed(increment.record, why), !is_exact, false}};
      }
    warn_of_nodes(increment, *finding.u);
    if (solver.search.is_needed())
      solver.search.accept(*finding.u, increment.record.time);
    // those after it started from what was not exact
    return {is_corrected ? Step::Outcome::corrected : Step::Outcome::accepted,
            parts.others_follow() ? k : k + 1};
  }

  bool
  IncrementAnalysis::correct(PendingIncrement      &increment,
                             verification::Finding &finding,
                             contact::SharedVector &w)
  {
    constexpr unsigned int most_steps   = 4;
    bool                   is_corrected = false;
    // of what is not finite nothing is known that could be corrected
    for (unsigned int step = 0;
         step < most_steps && std::isfinite(error_of(finding)) &&
         error_of(finding) > .1 * scene.solver.tolerance;
         ++step)
      {
        PendingIncrement better  = increment;
        auto             refined = solver.correct(better, *w, finding);
        if (!refined)
          break; // the result at hand is judged as it is
        const auto            of_better = contact::shared(std::move(*refined));
        verification::Finding found     = acceptance.judge(better, of_better);
        if (!(error_of(found) < .5 * error_of(finding)))
          break;
        increment    = std::move(better);
        finding      = std::move(found);
        w            = of_better;
        is_corrected = true;
      }
    return is_corrected;
  }

  void
  IncrementAnalysis::warn_of_nodes(const PendingIncrement &increment,
                                   const Eigen::VectorXd  &u)
  {
    const std::string when = "t = " + to_text(increment.record.time) + ": ";
    const auto        say  = [&](bool &said, const std::string &sentence) {
      said = !sentence.empty();
      if (said)
        log.say("warning: " + when + sentence + ".");
    };
    if (!said_between)
      say(said_between, between.comes_between(u, increment.record.time));
    if (!said_askew)
      say(said_askew, meets_askew(model, increment.state.r));
  }

  void
  IncrementAnalysis::go_on_otherwise(const unsigned int k, Failure failure)
  {
    if (solve_otherwise(failure) || cut(k, failure))
      return;
    model::IncrementRecord record;
    record.increment = k;
    record.time      = parts.end(scene.times[k - 1]);
    // the way on was not found: what is known is that there must be one
    const std::string why =
      failure.is_lost ? solver.why_it_leaves(k, record.time) : "";
    throw AnalysisError(why.empty() ? failure.why : failed(record, why));
  }

  /* Without condensation there is one method only. What it does not solve is
     condensed, or solved in parts where that takes too much memory. */
  bool
  IncrementAnalysis::solve_otherwise(Failure &failure)
  {
    if (backend->otherwise == nullptr || !failure.unsolved)
      return false;
    if (in_parts)
      {
        failure.why +=
          " Condensed bodies have more methods, but that takes more "
          "memory than this machine has.";
        return false;
      }
    bool fits = fits_condensed(model, scene.times.size(), scene.n_drawings());
    first_decides(fits);
    in_parts = !fits;
    if (fits)
      solver.condense_from_here(failure.why);
    else
      solver.solve_in_parts();
    return true;
  }

  bool
  IncrementAnalysis::cut(const unsigned int k, const Failure &failure)
  {
    const double whole    = scene.times[k - 1];
    const bool   has_laws = contact::has_nodal_laws(model.points);
    if (!failure.is_lost && !(failure.unsolved && has_laws))
      return false;
    const double start =
      failure.is_lost ? solver.search.time() : acceptance.accepted_time();
    const auto smallest = failure.is_lost ?
                            IncrementParts::Smallest::of_sliding :
                            IncrementParts::Smallest::of_load;
    if (!parts.cut(start, duration(k), whole, smallest))
      return false;
    log.note("increment " + std::to_string(k) +
             (failure.is_lost ? ": contacts that slide are not found" :
                                ": its laws of contact do not settle") +
             ", it is cut: a part up to t = " + to_text(parts.end(whole)));
    return true;
  }

  std::string
  IncrementAnalysis::name(const model::IncrementRecord &record) const
  {
    return increment_name(record);
  }
} // namespace conetact::analysis
