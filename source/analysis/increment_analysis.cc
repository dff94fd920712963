// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/increment_analysis.h"

#include "conetact/analysis/scene_report.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/candidates.h"
#include "conetact/contact/refusal.h"

#include <algorithm>
#include <limits>

namespace conetact
{
  namespace
  {
    double
    error_of(const Finding &finding)
    {
      return std::max(finding.residual, finding.equilibrium);
    }
  } // namespace

  IncrementAnalysis::IncrementAnalysis(const Scene &s, Log &l)
    : Analysis(s, l)
    , solver(make_solver(scene.solver))
  {}

  void
  IncrementAnalysis::run(const std::filesystem::path &folder, const bool quiet)
  {
    create_outputs(folder, scene.times.size(), quiet);
    std::vector<PendingIncrement> batch;
    for (unsigned int k = 1; k <= scene.times.size();)
      {
        try
          {
            batch.push_back(solve(k));
            ++k;
          }
        catch (const AnalysisError &)
          {
            // unless an increment before it is corrected: then once more
            if (const unsigned int next = finish(batch); next < k)
              k = next;
            else if (!condense_all())
              throw;
          }
        const bool full =
          batch.size() >=
          batch_size(k - 1 - static_cast<unsigned int>(batch.size()));
        if (!batch.empty() && (full || k > scene.times.size()))
          k = finish(batch);
      }
    report_skips(scene, model, loads, set, log);
  }

  std::size_t
  IncrementAnalysis::batch_size(const unsigned int n_finished) const
  {
    if (correcting)
      return 1;
    const std::size_t most = most_at_once(n_finished);
    // what follows an increment in which a node is missing is solved in vain
    return model.working_set().is_all() ?
             most :
             std::clamp<std::size_t>(n_finished - first_unsure, 1, most);
  }

  PendingIncrement
  IncrementAnalysis::solve(const unsigned int k)
  {
    PendingIncrement increment{
      {}, {}, {}, {}, {}, {}, {}, {}, history, history, {}};
    increment.record.increment = k;
    increment.record.time      = scene.times[k - 1];
    apply_loads(increment);
    increment.record.report = solve_contact(increment, history.start());
    return increment;
  }

  SolverReport
  IncrementAnalysis::solve_contact(PendingIncrement   &increment,
                                   const ContactState &guess)
  {
    ContactState &state = increment.end;
    state               = guess;
    SolverReport report;
    if (state.v.size() == 0)
      {
        report.converged  = true;
        report.solver     = "linear";
        increment.motions = history.free_motions();
        return report;
      }
    const ContactProblem problem = history.problem(increment.load);
    check_existence(problem, increment);
    report = solver->solve(problem, state);
    done.add(report);
    if (problem.system->form == Form::stiffness)
      state.u = elastic_part(problem, state);
    if (!report.converged)
      fail(increment.record,
           report.reason.empty() ?
             "the residual is " + to_text(report.residual) :
             report.reason);
    // nor were candidates that are left out
    if (report.substeps > 1 && !model.working_set().is_all())
      fail(increment.record, "it was solved in parts");
    const unsigned int number = increment.record.increment;
    if (scene.fclib_increments.count(number) +
          scene.text_increments.count(number) >
        0)
      increment.record.condensed = std::make_shared<const CondensedIncrement>(
        CondensedIncrement{problem,
                           report.substeps == 1 ?
                             std::optional<ContactState>(state) :
                             std::nullopt});
    increment.record.errors = kanno_errors(problem, state);
    history.advance(state);
    increment.state   = history.of_candidates(state, increment.before);
    increment.contact = history.displacements();
    increment.primal  = history.primal();
    increment.motions = history.free_motions();
    increment.after   = history;
    return report;
  }

  void
  IncrementAnalysis::check_existence(const ContactProblem   &problem,
                                     const PendingIncrement &increment)
  {
    if (problem.system->null_space.cols() == 0)
      return;
    if (!existence)
      existence = std::make_unique<ExistenceCheck>(make_existence_check(model));
    // at the start of the increment the reactions balance the load on the null
    // space
    const Existence result =
      existence->check(resultants_of(problem, model),
                       -increment.before.start().r.head(
                         problem.system->n_contact_unknowns()),
                       history.largest_force());
    if (!result.admissible)
      fail(increment.record,
           "no equilibrium exists, " + describe(result, model));
  }

  unsigned int
  IncrementAnalysis::finish(std::vector<PendingIncrement> &batch)
  {
    if (batch.empty())
      return std::numeric_limits<unsigned int>::max();
    std::vector<const LoadCase *> cases;
    std::vector<Eigen::VectorXd>  primal;
    for (const PendingIncrement &increment : batch)
      {
        cases.push_back(&increment.load);
        primal.push_back(increment.primal);
      }
    acceptance.set_stiffness(*model.condensation().system(),
                             model.working_set());
    const Eigen::MatrixXd        w = model.condensation().expand(cases, primal);
    const std::size_t            n_right = recover_all(batch, w);
    std::vector<IncrementRecord> finished;
    std::vector<PendingIncrement> all = std::move(batch);
    batch.clear();
    for (std::size_t i = 0; i < n_right; ++i)
      {
        bool corrected = false;
        try
          {
            corrected = check(all[i], w.col(static_cast<Eigen::Index>(i)));
          }
        catch (const AnalysisError &)
          {
            write(finished);
            history = all[i].before;
            if (!condense_all())
              throw;
            return all[i].record.increment;
          }
        finished.push_back(std::move(all[i].record));
        history = all[i].after;
        if (corrected)
          {
            correcting = true;
            write(finished);
            return finished.back().increment + 1;
            // those after it started from what was not exact
          }
      }
    write(finished);
    if (n_right == all.size())
      return finished.back().increment + 1;
    history = all[n_right].before;
    extend_set(all[n_right].after.gaps());
    first_unsure = all[n_right].record.increment - 1;
    return all[n_right].record.increment;
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

  bool
  IncrementAnalysis::check(PendingIncrement &increment, Eigen::VectorXd w)
  {
    constexpr unsigned int most_steps = 4;
    const ContactHistory   latest     = history;
    Finding                finding    = acceptance.judge(increment, w);
    bool                   corrected  = false;
    for (unsigned int step = 0;
         step < most_steps && error_of(finding) > .1 * scene.solver.tolerance;
         ++step)
      {
        PendingIncrement better = increment;
        Eigen::VectorXd  refined;
        try
          {
            refined = correct(better, w, finding);
          }
        catch (const AnalysisError &)
          {
            break; // the result at hand is judged as it is
          }
        Finding found = acceptance.judge(better, refined);
        if (!(error_of(found) < .5 * error_of(finding)))
          break;
        increment = std::move(better);
        finding   = std::move(found);
        w         = refined;
        corrected = true;
      }
    history = latest;
    if (corrected)
      recover(increment, w);
    complete(increment, finding, w);
    return corrected;
  }

  Eigen::VectorXd
  IncrementAnalysis::correct(PendingIncrement      &increment,
                             const Eigen::VectorXd &w,
                             const Finding         &finding)
  {
    // the relation holds for rounded matrices; the true one leaves forces
    // unbalanced, and contacts elsewhere than the recovered displacements
    ElasticBackend &elastic = model.condensation();
    increment.load.f -= elastic.reduce_unbalanced(finding.unbalanced);
    ContactState guess = increment.before.start();
    if (model.is_dual())
      {
        const Eigen::VectorXd missed =
          model.working_set().gather(finding.displacements - increment.contact);
        increment.load.f.head(missed.size()) += missed;
        guess      = increment.end;
        guess.node = increment.end.node;
        guess.r.tail(increment.motions.size()).setZero();
      }
    history = increment.before;
    history.linearise_at(increment.motions);
    const unsigned int    before = increment.record.report.iterations;
    const Eigen::VectorXd old    = increment.primal;
    increment.record.report      = solve_contact(increment, guess);
    increment.record.report.iterations += before;
    return w + elastic.correction(finding.unbalanced, increment.primal - old);
  }

  std::string
  IncrementAnalysis::name(const IncrementRecord &record) const
  {
    return "Increment " + std::to_string(record.increment) + " of " +
           std::to_string(scene.times.size());
  }
} // namespace conetact
