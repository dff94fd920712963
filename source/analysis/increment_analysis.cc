// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/increment_analysis.h"

#include "conetact/analysis/cost.h"
#include "conetact/analysis/scene_report.h"
#include "conetact/base/errors.h"
#include "conetact/base/interruption.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"
#include "conetact/solvers/large_newton.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::analysis
{
  namespace
  {
    /** Without free motions. */
    solvers::ContactState
    of_contacts(const solvers::ContactState &state, const Eigen::Index n)
    {
      return {state.v.head(n), state.r.head(n), state.node};
    }

    /** What is joined for good has no strength that could be too small. */
    bool
    has_bonded_nodes(const solvers::ContactProblem &problem)
    {
      bool any = false;
      for (Eigen::Index i = 0; i < problem.system->n_nodes(); ++i)
        any = any || problem.is_bonded(i);
      return any;
    }

    double
    error_of(const verification::Finding &finding)
    {
      return std::max(finding.residual, finding.equilibrium);
    }
  } // namespace

  IncrementAnalysis::IncrementAnalysis(const application::Scene &s, Log &l)
    : Analysis(s, l)
    , solver(backend->create_solver(scene, model))
    , search(scene.sliding_contacts(), model)
    , wear_error(model.points)
  {
    check_branches();
    if (scene.restart)
      restore_state();
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
              if (!solve_otherwise(step.why) && !cut(next))
                {
                  const std::string why = why_it_leaves(next);
                  throw AnalysisError(why.empty() ? step.why : why);
                }
              if (!is_in_team()) // the first process goes on alone
                return;
          }
      }
    report_skips(scene, model, loads, log);
    wear_error.report(scene.contact_names, log);
  }

  std::size_t
  IncrementAnalysis::batch_size(const unsigned int n_finished) const
  {
    if (one_by_one || scene.follows_branches || search.is_needed() ||
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
      return batch.size() >= size ||
             (!batch.empty() && Interruption::is_wanted());
    };
    for (; k <= scene.times.size() && !is_full() && !lock_is_due(k); ++k)
      {
        batch.push_back(start(k));
        std::string why = search.turns_too_far(batch.back().record.time);
        lost_contacts   = !why.empty();
        start_is_known  = batch.size() == 1;
        if (why.empty())
          why = solve_contact(batch.back(), history.start());
        if (why.empty() && !start_is_known &&
            open_motions(batch.back()).exist())
          {
            // how long its way is says the end of the one before
            history    = batch.back().before;
            one_by_one = true;
            batch.pop_back();
            break;
          }
        if (why.empty() && search.is_needed())
          {
            why           = settle(batch.back());
            lost_contacts = !why.empty();
          }
        if (!why.empty())
          {
            const std::string failure = failed(batch.back().record, why);
            history                   = batch.back().before;
            batch.pop_back();
            return {Step::Outcome::failed, k, failure};
          }
      }
    return {Step::Outcome::accepted, parts.others_follow() ? first : k, {}};
  }

  double
  IncrementAnalysis::begin(const unsigned int k) const
  {
    AssertIndexRange(k, scene.times.size() + 1);
    return k > 1 ? scene.times[k - 2] : 0.;
  }

  bool
  IncrementAnalysis::lock_is_due(const unsigned int k) const
  {
    const auto &cuts = model.bodies.cuts;
    return std::any_of(cuts.begin(), cuts.end(), [&](const contact::Cut &cut) {
      return !cut.opening && cut.is_due(begin(k));
    });
  }

  /* Other motions are free from here on. */
  void
  IncrementAnalysis::lock(const unsigned int k)
  {
    history.lock_cuts(begin(k), acceptance.accepted_displacements());
    existence.reset();
    solver = backend->create_solver(scene, model);
    forget_halves();
    log.note("increment " + std::to_string(k) + ": preloads are locked");
  }

  PendingIncrement
  IncrementAnalysis::start(const unsigned int k)
  {
    const double t = parts.end(scene.times[k - 1]);
    if (search.is_needed())
      must_take(search.guess(t));
    PendingIncrement increment{history, history};
    increment.record.increment = k;
    increment.record.time      = t;
    apply_loads(increment);
    return increment;
  }

  std::string
  IncrementAnalysis::solve_contact(PendingIncrement            &increment,
                                   const solvers::ContactState &guess)
  {
    solvers::ContactState &state  = increment.end;
    solvers::SolverReport &report = increment.record.report;
    state                         = guess;
    report                        = {};
    if (state.v.size() == 0)
      {
        report.converged  = true;
        report.solver     = "linear";
        increment.motions = history.free_motions();
        increment.primal  = history.primal();
        take_bound(increment);
        return "";
      }
    solvers::ContactProblem problem = history.problem(increment.load);
    unsolved                        = false;
    if (const std::string why = no_equilibrium(problem, increment);
        !why.empty())
      return why;
    if (problem.system->n_nodes() == 0)
      solve_motions(problem, state, report);
    else
      report = solver->solve(problem, state);
    if (!report.converged && state.nearby.size() > 0 &&
        history.linearise_about(problem, state))
      {
        done.add(report);
        problem = history.problem(increment.load);
        state   = history.start();
        report  = solver->solve(problem, state);
      }
    done.add(report);
    let_fluid_in(increment, guess, problem);
    unsolved = !report.converged;
    if (const std::string limit = unsolved ? limit_of(problem, increment) : "";
        !limit.empty())
      return limit;
    if (unsolved)
      {
        std::string why = report.reason.empty() ?
                            "the residual is " + to_text(report.residual) :
                            report.reason;
        if (has_bonded_nodes(problem))
          why += "; where bonds give way, or fluids press bodies apart, "
                 "nothing may hold at this load: move bodies by supports, or "
                 "take smaller increments";
        return why;
      }
    if (scene.judges_uniqueness)
      judge_uniqueness(increment, problem);
    take_result(increment, problem);
    if (scene.follows_branches)
      follow_branches(increment, problem);
    if (start_is_known)
      shorten_way(increment, problem);
    return "";
  }

  void
  IncrementAnalysis::keep(output::IncrementRecord               record,
                          std::vector<output::IncrementRecord> &finished)
  {
    if (parts.take(record))
      finished.push_back(std::move(record));
  }

  void
  IncrementAnalysis::take_result(PendingIncrement              &increment,
                                 const solvers::ContactProblem &problem)
  {
    solvers::ContactState &state = increment.end;
    if (problem.system->form == solvers::Form::stiffness)
      state.u = solvers::elastic_part(problem, state);
    const unsigned int number = increment.record.increment;
    if (scene.fclib_increments.count(number) +
          scene.text_increments.count(number) >
        0)
      increment.record.condensed =
        std::make_shared<const output::CondensedIncrement>(
          output::CondensedIncrement{
            solvers::with_coefficients_of(state, problem),
            increment.record.report.substeps == 1 ?
              std::optional<solvers::ContactState>(state) :
              std::nullopt});
    increment.record.errors = solvers::kanno_errors(problem, state);
    increment.base          = history.linearised_at();
    const contact::IncrementLaws *const laws = increment.load.laws.get();
    history.advance(state, increment.record.time, laws);
    if (laws != nullptr)
      model.points.set_friction(laws->coefficients(state));
    increment.state   = of_contacts(state, model.points.n_unknowns());
    increment.contact = history.displacements();
    increment.primal  = history.primal();
    increment.motions = history.free_motions();
    increment.after   = history;
    take_bound(increment);
  }

  void
  IncrementAnalysis::take_bound(PendingIncrement &increment)
  {
    increment.bound =
      model.elasticity().bound_state(increment.load, increment.primal);
  }

  Eigen::MatrixXd
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
    return model.elasticity().expand(cases, primal);
  }

  /* Decisions rest on these numbers. */
  void
  IncrementAnalysis::demand_equal(const std::vector<PendingIncrement> &batch,
                                  const Eigen::MatrixXd               &w)
  {
    std::vector<std::pair<const double *, Eigen::Index>> numbers = {
      {w.data(), w.size()}};
    for (const PendingIncrement &increment : batch)
      for (const Eigen::VectorXd *x : {&increment.end.v, &increment.end.r})
        numbers.emplace_back(x->data(), x->size());
    conetact::demand_equal(numbers);
  }

  IncrementAnalysis::Step
  IncrementAnalysis::finish(std::vector<PendingIncrement> &batch)
  {
    AssertIndexRange(batch.size(), scene.times.size() + 1);
    using Outcome  = Step::Outcome;
    start_is_known = true;
    if (batch.empty())
      return {};
    const Eigen::MatrixXd w = deformations(batch);
    demand_equal(batch, w);
    std::vector<output::IncrementRecord> finished;
    Step                                 step;
    for (std::size_t i = 0;
         i < batch.size() && step.outcome == Outcome::accepted;
         ++i)
      {
        step = check(batch[i], w.col(static_cast<Eigen::Index>(i)));
        const bool has_failed = step.outcome == Outcome::failed;
        history               = has_failed ? batch[i].before : batch[i].after;
        if (!has_failed)
          {
            say_leaks(batch[i]);
            estimate_wear(batch[i]);
            keep(std::move(batch[i].record), finished);
          }
      }
    write(finished);
    for (const output::IncrementRecord &record : finished)
      n_reaction_rows += record.rows.size();
    return step;
  }

  /* Without condensation there is one method only. What it does not solve is
     condensed, or solved in parts where that takes too much memory. */
  bool
  IncrementAnalysis::solve_otherwise(std::string &why)
  {
    if (backend->otherwise == nullptr || !unsolved)
      return false;
    if (in_parts)
      {
        why += " Condensed bodies have more methods, but that takes more "
               "memory than this machine has.";
        return false;
      }
    bool fits = fits_condensed(model, scene.times.size(), scene.n_drawings());
    first_decides(fits);
    if (!fits)
      {
        in_parts = true;
        solver   = std::make_unique<solvers::LargeNewton>(scene.solver);
        return true;
      }
    condense_from_here(why);
    return true;
  }

  IncrementAnalysis::Step
  IncrementAnalysis::check(PendingIncrement &increment, Eigen::VectorXd w)
  {
    AssertDimension(w.size(), model.coordinates.n_dofs());
    constexpr unsigned int most_steps = 4;
    verification::Finding  finding    = acceptance.judge(increment, w);
    bool                   corrected  = false;
    // of what is not finite nothing is known that could be corrected
    for (unsigned int step = 0;
         step < most_steps && std::isfinite(error_of(finding)) &&
         error_of(finding) > .1 * scene.solver.tolerance;
         ++step)
      {
        PendingIncrement better  = increment;
        const auto       refined = correct(better, w, finding);
        if (!refined)
          break; // the result at hand is judged as it is
        verification::Finding found = acceptance.judge(better, *refined);
        if (!(error_of(found) < .5 * error_of(finding)))
          break;
        increment = std::move(better);
        finding   = std::move(found);
        w         = *refined;
        corrected = true;
      }
    const unsigned int k = increment.record.increment;
    if (increment.another)
      increment.record.other_rows =
        rows_of_solution(increment, increment.before, *increment.another);
    if (scene.follows_branches)
      increment.record.branches = rows_of_branches(increment);
    const std::string why = complete(increment, finding, w);
    unsolved              = !(error_of(finding) <= scene.solver.tolerance);
    if (!why.empty())
      return {Step::Outcome::failed, k, failed(increment.record, why)};
    warn_of_nodes(increment, finding.u);
    if (search.is_needed())
      search.accept(finding.u, increment.record.time);
    // those after it started from what was not exact
    return {corrected ? Step::Outcome::corrected : Step::Outcome::accepted,
            parts.others_follow() ? k : k + 1,
            {}};
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
      say(said_between, search.comes_between(u, increment.record.time));
    if (!said_askew)
      say(said_askew, search.meets_askew(increment));
  }

  std::optional<Eigen::VectorXd>
  IncrementAnalysis::correct(PendingIncrement            &increment,
                             const Eigen::VectorXd       &w,
                             const verification::Finding &finding)
  {
    // the relation holds for rounded matrices; the true one leaves forces
    // unbalanced, and contacts elsewhere than the recovered displacements
    const contact::Elasticity &elastic = model.elasticity();
    contact::LoadCase change = elastic.reduce_unbalanced(finding.unbalanced);
    elastic.add_missed(finding.displacements.head(model.points.n_unknowns()) -
                         increment.contact,
                       finding.missed_by_bound,
                       change);
    // Where a body has moved further than it deforms, the rounding of this way
    // is what is left.
    const bool is_rounded =
      elastic.is_rounded_by(increment.motions - increment.base, w);
    if (!is_rounded)
      increment.load.f += change.f;
    if (!is_rounded && change.bound.size() > 0)
      increment.load.bound += change.bound;
    history = increment.before;
    history.linearise_at(increment.motions);
    const solvers::ContactState guess =
      elastic.restart(history.start(), increment.end);
    const unsigned int    before = increment.record.report.iterations;
    const Eigen::VectorXd old    = increment.primal;
    if (!solve_contact(increment, guess).empty())
      return {};
    increment.record.report.iterations += before;
    return w + elastic.correction(change, increment.primal - old);
  }

  std::string
  IncrementAnalysis::name(const output::IncrementRecord &record) const
  {
    return "Increment " + std::to_string(record.increment) + " of " +
           std::to_string(scene.times.size());
  }
} // namespace conetact::analysis
