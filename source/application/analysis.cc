// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/analysis.h"

#include "conetact/application/path_analysis.h"
#include "conetact/application/scene_report.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/candidates.h"
#include "conetact/contact/refusal.h"
#include "conetact/output/problem_files.h"
#include "conetact/output/progress.h"

#include <algorithm>
#include <cmath>
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

    /** Throws InputError for a contact none of whose nodes may touch. */
    void
    refuse_empty_contacts(const Scene &scene, const ContactModel &model)
    {
      std::vector<bool> empty(scene.contact_names.size(), true);
      for (const NodeRule *rule : model.coordinates.contact_rules())
        empty[rule->contact_node->contact] = false;
      for (std::size_t c = 0; c < empty.size(); ++c)
        if (empty[c])
          throw InputError(
            "Contact '" + scene.contact_names[c] +
            "' has no node that may touch: " +
            (scene.n_free_nodes[c] > 0 ?
               "none faces the master. Check Master boundary ids and the gap " :
               "supports hold all of them along its normal. Take them out of "
               "the supports") +
            std::string(", or remove the contact."));
    }
  } // namespace

  Analysis::Analysis(const Scene &s, Log &l)
    : scene(s)
    , log(l)
    , model(scene.bodies, scene.times)
    , loads(scene.nodal_loads())
    , prestress(scene.prestress())
    , history(model)
    , set(model)
    , acceptance(scene, model)
    , solver(make_solver(scene.solver))
  {
    refuse_empty_contacts(scene, model);
  }

  void
  Analysis::report()
  {
    if (scene.leave_out_far_nodes)
      set.start([&](const double t) { return loads.at(t); }, scene.times);
    report_sizes(scene, model, log);
  }

  void
  Analysis::estimate() const
  {
    report_cost(scene, model, log);
  }

  void
  Analysis::check_history()
  {
    for (const double t : scene.times)
      {
        loads.at(t);
        model.coordinates.prescribed(t);
        model.elastic.ground_forces(t);
      }
    log.time("loads and supports at all times");
  }

  void
  Analysis::prepare()
  {
    check_history();
    const double bytes = model.condensation().factor_bytes();
    log.time("condensation: order, factor and Schur complement, factor of " +
             to_text(bytes / 1e6) + " MB");
    if (!scene.fclib_increments.empty())
      check_problem_is_writable(*model.condensation().system());
  }

  void
  Analysis::create_outputs(const std::filesystem::path &folder,
                           const bool                   quiet)
  {
    description.folder       = folder;
    description.contacts     = scene.contact_sides;
    description.bodies       = scene.bodies.names;
    description.structures   = scene.bodies.structures;
    description.dim          = scene.bodies.dim;
    description.n_increments = static_cast<unsigned int>(scene.times.size());
    description.vtu_every    = scene.vtu_every;
    for (const OutputRow &row : output_table())
      outputs.push_back(row.create(description));
    outputs.push_back(std::make_unique<Progress>(description, quiet));
  }

  std::size_t
  Analysis::batch_size(const unsigned int n_finished) const
  {
    // Recovering displacements of several increments in one solve is cheaper;
    // large scenes write each increment sooner. Each batch rewrites the tables:
    // as batches grow with a long history, all that is written does not grow
    // with its square.
    if (correcting)
      return 1;
    const Eigen::Index n = model.coordinates.n_unknowns();
    const auto         most =
      std::clamp<Eigen::Index>(16000000 / std::max<Eigen::Index>(n, 1),
                               1,
                               std::max(16u, n_finished / 8));
    // what follows an increment in which a node is missing is solved in vain
    const auto sure = model.working_set().is_all() ?
                        most :
                        std::max<Eigen::Index>(1, n_finished - first_unsure);
    return static_cast<std::size_t>(std::min(most, sure));
  }

  void
  Analysis::run(const std::filesystem::path &folder, const bool quiet)
  {
    create_outputs(folder, quiet);
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

  Work
  Analysis::work() const
  {
    Work work              = done;
    work.elastic           = model.work();
    work.load_integrations = loads.n_integrations();
    for (const auto &output : outputs)
      {
        work.outputs.drawings += output->work().drawings;
        work.outputs.table_bytes += output->work().table_bytes;
      }
    return work;
  }

  PendingIncrement
  Analysis::solve(const unsigned int k)
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
  Analysis::solve_contact(const Condensation::Load &load,
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
  Analysis::check_existence(const ContactProblem   &problem,
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
  Analysis::finish(std::vector<PendingIncrement> &batch)
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
  Analysis::recover(PendingIncrement &increment, const Eigen::VectorXd &u) const
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
  Analysis::recover_all(std::vector<PendingIncrement> &batch,
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
  Analysis::extend_set(const Eigen::VectorXd &gaps)
  {
    const std::size_t before = set.size(), n_new = set.extend(gaps);
    existence.reset();
    log.time("working set: " + std::to_string(n_new) + " contact nodes join " +
             std::to_string(before));
  }

  bool
  Analysis::condense_all()
  {
    if (!set.take_all())
      return false;
    log.note("working set: all contact nodes, the increment is not solved "
             "without");
    existence.reset();
    return true;
  }

  bool
  Analysis::check(PendingIncrement &increment, Eigen::VectorXd u)
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
  Analysis::correct(PendingIncrement      &increment,
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

  void
  Analysis::complete(PendingIncrement      &increment,
                     const Equilibrium     &e,
                     const Eigen::VectorXd &u)
  {
    const unsigned int k     = increment.record.increment;
    const bool         drawn = description.is_drawn(k) ||
                       (scene.adaptive.cycles > 0 && k == scene.times.size());
    if (const std::string why = acceptance.complete(increment, e, u, drawn);
        !why.empty())
      fail(increment.record, why);
  }

  void
  Analysis::write(const std::vector<IncrementRecord> &finished)
  {
    if (finished.empty())
      return;
    log.time("contact, displacements and equilibrium of " +
             std::to_string(finished.size()) + " increments");
    for (const auto &output : outputs)
      output->write(finished);
    if (scene.adaptive.cycles > 0)
      final_record = finished.back();
    log.time("their tables and drawings");
    for (const IncrementRecord &record : finished)
      log.note(name(record) + ", " + record.report.solver + ": " +
               std::to_string(record.report.iterations) +
               " linear solves, residual " + to_text(record.report.residual) +
               ", equilibrium " + to_text(record.equilibrium));
  }

  std::string
  Analysis::name(const IncrementRecord &record) const
  {
    return "Increment " + std::to_string(record.increment) + " of " +
           std::to_string(scene.times.size());
  }

  void
  Analysis::fail(const IncrementRecord &record, const std::string &why) const
  {
    throw AnalysisError(
      name(record) + " (t = " + to_text(record.time) + "): " + why + "." +
      (record.increment > 1 ? " The increments before it are on disk." : ""));
  }

  std::unique_ptr<Analysis>
  make_analysis(const Scene &scene, Log &log)
  {
    if (scene.path.method == PathSettings::Method::none)
      return std::make_unique<Analysis>(scene, log);
    return std::make_unique<PathAnalysis>(scene, log);
  }
} // namespace conetact
