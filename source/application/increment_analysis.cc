// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/increment_analysis.h"

#include "conetact/application/scene_report.h"
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
    error_of(const Equilibrium &e)
    {
      return std::max(e.residual, e.balance);
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
    PendingIncrement increment{{}, {}, {}, {}, {}, history, history, {}};
    increment.record.increment = k;
    increment.record.time      = scene.times[k - 1];
    increment.forces           = loads.at(increment.record.time) + prestress;
    increment.load             = model.condensation().reduce(
      increment.forces + model.elastic.ground_forces(increment.record.time),
      model.coordinates.prescribed(increment.record.time));
    increment.record.report = solve_contact(increment.load, increment);
    increment.contact       = history.displacements();
    increment.after         = history;
    return increment;
  }

  SolverReport
  IncrementAnalysis::solve_contact(const Condensation::Load &load,
                                   PendingIncrement         &increment)
  {
    ContactState &state = increment.end;
    state               = history.start();
    SolverReport report;
    if (state.v.size() == 0)
      {
        report.converged = true;
        report.solver    = "linear";
        return report;
      }
    const ContactProblem problem = history.problem(load);
    check_existence(problem, state.r, increment);
    report = solver->solve(problem, state);
    done.add(report);
    // parts of an increment were checked one by one: the law is incremental
    if (report.substeps == 1)
      report.residual = contact_residual(problem, state);
    if (!report.converged || !(report.residual <= scene.solver.tolerance))
      fail(increment.record,
           report.reason.empty() ?
             "the residual is " + to_text(report.residual) :
             report.reason);
    // nor were candidates that are left out
    if (report.substeps > 1 && !model.working_set().is_all())
      fail(increment.record, "it was solved in parts");
    if (scene.fclib_increments.count(increment.record.increment) > 0)
      increment.record.condensed = std::make_shared<const CondensedIncrement>(
        CondensedIncrement{problem,
                           report.substeps == 1 ?
                             std::optional<ContactState>(state) :
                             std::nullopt});
    increment.record.errors = kanno_errors(problem, state);
    history.advance(state);
    increment.state = history.of_candidates(state, increment.before);
    return report;
  }

  void
  IncrementAnalysis::check_existence(const ContactProblem   &problem,
                                     const Eigen::VectorXd  &start,
                                     const PendingIncrement &increment)
  {
    if (problem.system->null_space.cols() == 0)
      return;
    if (!existence)
      existence = std::make_unique<ExistenceCheck>(make_existence_check(model));
    // at the start of the increment the reactions balance the load on the null
    // space
    const Existence result =
      existence->check(problem.load, -start, problem.reference_force);
    if (!result.admissible)
      fail(increment.record,
           "no equilibrium exists, " + describe(result, model));
  }

  unsigned int
  IncrementAnalysis::finish(std::vector<PendingIncrement> &batch)
  {
    if (batch.empty())
      return std::numeric_limits<unsigned int>::max();
    std::vector<const Condensation::Load *> cases;
    std::vector<Eigen::VectorXd>            contact;
    for (const PendingIncrement &increment : batch)
      {
        cases.push_back(&increment.load);
        contact.push_back(model.working_set().gather(increment.contact));
      }
    const Eigen::MatrixXd u       = model.condensation().expand(cases, contact);
    const std::size_t     n_right = recover_all(batch, u);
    std::vector<IncrementRecord>  finished;
    std::vector<PendingIncrement> all = std::move(batch);
    batch.clear();
    for (std::size_t i = 0; i < n_right; ++i)
      {
        bool corrected = false;
        try
          {
            corrected = check(all[i], u.col(static_cast<Eigen::Index>(i)));
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
                             const Eigen::VectorXd &u) const
  {
    if (model.working_set().is_all())
      return;
    increment.after.recover(
      candidate_displacements(model, u, increment.record.time));
    increment.state =
      increment.after.of_candidates(increment.end, increment.before);
    increment.contact = increment.after.displacements();
  }

  std::size_t
  IncrementAnalysis::recover_all(std::vector<PendingIncrement> &batch,
                                 const Eigen::MatrixXd         &u) const
  {
    for (std::size_t i = 0; i < batch.size(); ++i)
      {
        if (i > 0)
          batch[i].before = batch[i - 1].after;
        recover(batch[i], u.col(static_cast<Eigen::Index>(i)));
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
  IncrementAnalysis::check(PendingIncrement &increment, Eigen::VectorXd u)
  {
    constexpr unsigned int most_steps = 3;
    const ContactHistory   latest     = history;
    Equilibrium            e          = acceptance.judge(increment, u);
    bool                   corrected  = false;
    for (unsigned int step = 0;
         step < most_steps && error_of(e) > .1 * scene.solver.tolerance;
         ++step)
      {
        PendingIncrement better = increment;
        Eigen::VectorXd  refined;
        try
          {
            refined = correct(better, u, e.unbalanced);
          }
        catch (const AnalysisError &)
          {
            break; // the result at hand is judged as it is
          }
        Equilibrium e_new = acceptance.judge(better, refined);
        if (!(error_of(e_new) < .5 * error_of(e)))
          break;
        increment = std::move(better);
        e         = std::move(e_new);
        u         = refined;
        corrected = true;
      }
    history = latest;
    if (corrected)
      recover(increment, u);
    complete(increment, e, u);
    return corrected;
  }

  Eigen::VectorXd
  IncrementAnalysis::correct(PendingIncrement      &increment,
                             const Eigen::VectorXd &u,
                             const Eigen::VectorXd &unbalanced)
  {
    // K q = r + f holds for the rounded K; the true one leaves `unbalanced`
    history = increment.before;
    increment.load.f -= model.condensation().reduce_unbalanced(unbalanced);
    const unsigned int    before = increment.record.report.iterations;
    const Eigen::VectorXd old    = increment.contact;
    increment.record.report      = solve_contact(increment.load, increment);
    increment.record.report.iterations += before;
    increment.contact            = history.displacements();
    increment.after              = history;
    const Eigen::VectorXd change = increment.contact - old;
    return u +
           model.condensation().correction(unbalanced,
                                           model.working_set().gather(change));
  }

  std::string
  IncrementAnalysis::name(const IncrementRecord &record) const
  {
    return "Increment " + std::to_string(record.increment) + " of " +
           std::to_string(scene.times.size());
  }
} // namespace conetact
