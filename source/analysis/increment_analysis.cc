// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/increment_analysis.h"

#include "conetact/analysis/scene_report.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/candidates.h"
#include "conetact/contact/refusal.h"
#include "conetact/solvers/large_newton.h"
#include "conetact/solvers/solver_table.h"

#include <algorithm>

namespace conetact::analysis
{
  namespace
  {
    std::unique_ptr<solvers::ContactSolver>
    solver_of(const solvers::SolverOptions &options,
              const contact::ContactModel  &model)
    {
      if (model.is_iterative())
        return std::make_unique<solvers::LargeNewton>(options);
      return solvers::make_solver(options);
    }

    double
    error_of(const verification::Finding &finding)
    {
      return std::max(finding.residual, finding.equilibrium);
    }
  } // namespace

  IncrementAnalysis::IncrementAnalysis(const application::Scene &s, Log &l)
    : Analysis(s, l)
    , solver(solver_of(scene.solver, model))
  {}

  void
  IncrementAnalysis::run(const std::filesystem::path &folder, const bool quiet)
  {
    using Outcome = Step::Outcome;
    create_outputs(folder, scene.times.size(), quiet);
    for (unsigned int next = 1; next <= scene.times.size();)
      {
        std::vector<PendingIncrement> batch;
        const Step                    solved = solve_batch(next, batch);
        Step                          step   = finish(batch);
        if (step.outcome == Outcome::accepted)
          step = solved;
        next = step.next;
        switch (step.outcome)
          {
            case Outcome::accepted:
              break;
            case Outcome::corrected:
              correcting = true;
              break;
            case Outcome::needs_more_nodes:
              extend_set(step.gaps);
              first_unsure = next - 1;
              break;
            case Outcome::failed:
              if (!condense_all())
                throw AnalysisError(step.why);
          }
      }
    report_skips(scene, model, loads, set, log);
  }

  std::size_t
  IncrementAnalysis::batch_size(const unsigned int n_finished) const
  {
    // nor is anything gained where nothing is condensed
    if (correcting || model.is_iterative())
      return 1;
    const std::size_t most = most_at_once(n_finished);
    // what follows an increment in which a node is missing is solved in vain
    return model.working_set().is_all() ?
             most :
             std::clamp<std::size_t>(n_finished - first_unsure, 1, most);
  }

  IncrementAnalysis::Step
  IncrementAnalysis::solve_batch(const unsigned int             first,
                                 std::vector<PendingIncrement> &batch)
  {
    const std::size_t size = batch_size(first - 1);
    unsigned int      k    = first;
    for (; k <= scene.times.size() && batch.size() < size; ++k)
      {
        batch.push_back(start(k));
        const std::string why = solve_contact(batch.back(), history.start());
        if (!why.empty())
          {
            const std::string failure = failed(batch.back().record, why);
            batch.pop_back();
            return {Step::Outcome::failed, k, failure, {}};
          }
      }
    return {Step::Outcome::accepted, k, {}, {}};
  }

  PendingIncrement
  IncrementAnalysis::start(const unsigned int k)
  {
    PendingIncrement increment{history, history};
    increment.record.increment = k;
    increment.record.time      = scene.times[k - 1];
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
    const solvers::ContactProblem problem = history.problem(increment.load);
    if (const std::string why = no_equilibrium(problem, increment);
        !why.empty())
      return why;
    report = solver->solve(problem, state);
    done.add(report);
    if (!report.converged)
      return report.reason.empty() ?
               "the residual is " + to_text(report.residual) :
               report.reason;
    // nor were candidates that are left out
    if (report.substeps > 1 && !model.working_set().is_all())
      return "it was solved in parts";
    take_result(increment, problem);
    return "";
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
          output::CondensedIncrement{problem,
                                     increment.record.report.substeps == 1 ?
                                       std::optional<solvers::ContactState>(
                                         state) :
                                       std::nullopt});
    increment.record.errors = solvers::kanno_errors(problem, state);
    history.advance(state);
    increment.state   = history.of_candidates(state, increment.before);
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
      model.condense().bound_state(increment.load, increment.primal);
  }

  std::string
  IncrementAnalysis::no_equilibrium(const solvers::ContactProblem &problem,
                                    const PendingIncrement        &increment)
  {
    if (problem.system->null_space.cols() == 0)
      return "";
    if (!existence)
      existence = std::make_unique<solvers::ExistenceCheck>(
        contact::make_existence_check(model));
    // at the start of the increment the reactions balance the load on the null
    // space
    const solvers::Existence result =
      existence->check(contact::resultants_of(problem, model),
                       -increment.before.start().r.head(
                         problem.system->n_contact_unknowns()),
                       history.largest_force());
    return result.admissible ?
             "" :
             "no equilibrium exists, " + describe(result, model);
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
    acceptance.set_stiffness(model.condense());
    return model.condense().expand(cases, primal);
  }

  IncrementAnalysis::Step
  IncrementAnalysis::finish(std::vector<PendingIncrement> &batch)
  {
    using Outcome = Step::Outcome;
    if (batch.empty())
      return {};
    const Eigen::MatrixXd                w       = deformations(batch);
    const std::size_t                    n_right = recover_all(batch, w);
    std::vector<output::IncrementRecord> finished;
    Step                                 step;
    for (std::size_t i = 0; i < n_right && step.outcome == Outcome::accepted;
         ++i)
      {
        step = check(batch[i], w.col(static_cast<Eigen::Index>(i)));
        const bool has_failed = step.outcome == Outcome::failed;
        history               = has_failed ? batch[i].before : batch[i].after;
        if (!has_failed)
          finished.push_back(std::move(batch[i].record));
      }
    write(finished);
    if (step.outcome != Outcome::accepted || n_right == batch.size())
      return step;
    history = batch[n_right].before;
    return {Outcome::needs_more_nodes,
            batch[n_right].record.increment,
            {},
            batch[n_right].after.gaps()};
  }

  void
  IncrementAnalysis::recover(PendingIncrement      &increment,
                             const Eigen::VectorXd &w) const
  {
    if (model.working_set().is_all())
      return;
    increment.after.recover(
      model.relative_displacements(acceptance.displacements(increment, w),
                                   increment.record.time));
    increment.state =
      increment.after.of_candidates(increment.end, increment.before);
    increment.contact = increment.after.displacements();
  }

  std::size_t
  IncrementAnalysis::recover_all(std::vector<PendingIncrement> &batch,
                                 const Eigen::MatrixXd         &w) const
  {
    for (std::size_t i = 0; i < batch.size(); ++i)
      {
        if (i > 0)
          batch[i].before = batch[i - 1].after;
        recover(batch[i], w.col(static_cast<Eigen::Index>(i)));
        if (!set.suffices(batch[i].after.gaps()))
          return i;
      }
    return batch.size();
  }

  void
  IncrementAnalysis::extend_set(const Eigen::VectorXd &gaps)
  {
    const std::size_t before = set.size(), n_new = set.extend(gaps);
    existence.reset();
    log.time("working set: " + std::to_string(n_new) + " contact nodes join " +
             std::to_string(before));
  }

  bool
  IncrementAnalysis::condense_all()
  {
    if (!set.take_all())
      return false;
    log.note("working set: all contact nodes, the increment is not solved "
             "without");
    existence.reset();
    return true;
  }

  IncrementAnalysis::Step
  IncrementAnalysis::check(PendingIncrement &increment, Eigen::VectorXd w)
  {
    constexpr unsigned int most_steps = 4;
    verification::Finding  finding    = acceptance.judge(increment, w);
    bool                   corrected  = false;
    for (unsigned int step = 0;
         step < most_steps && error_of(finding) > .1 * scene.solver.tolerance;
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
    if (corrected)
      recover(increment, w);
    const unsigned int k   = increment.record.increment;
    const std::string  why = complete(increment, finding, w);
    if (!why.empty())
      return {Step::Outcome::failed, k, failed(increment.record, why), {}};
    // those after it started from what was not exact
    return {corrected ? Step::Outcome::corrected : Step::Outcome::accepted,
            k + 1,
            {},
            {}};
  }

  std::optional<Eigen::VectorXd>
  IncrementAnalysis::correct(PendingIncrement            &increment,
                             const Eigen::VectorXd       &w,
                             const verification::Finding &finding)
  {
    // the relation holds for rounded matrices; the true one leaves forces
    // unbalanced, and contacts elsewhere than the recovered displacements
    contact::ElasticBackend &elastic = model.condense();
    contact::LoadCase change    = elastic.reduce_unbalanced(finding.unbalanced);
    solvers::ContactState guess = increment.before.start();
    if (model.is_dual())
      {
        const Eigen::Index    n      = model.points.n_unknowns();
        const Eigen::VectorXd missed = model.working_set().gather(
          finding.displacements.head(n) - increment.contact);
        change.f.head(missed.size()) += missed;
        elastic.move_bound(finding.missed_by_bound, change);
        guess      = increment.end;
        guess.node = increment.end.node;
        guess.r.tail(increment.motions.size()).setZero();
      }
    increment.load.f += change.f;
    if (change.bound.size() > 0)
      increment.load.bound += change.bound;
    history = increment.before;
    history.linearise_at(increment.motions);
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
