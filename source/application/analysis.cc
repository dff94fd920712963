// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/analysis.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/equilibrium.h"
#include "conetact/output/progress.h"

namespace conetact
{
  Analysis::Analysis(const Scene &s, Log &l)
    : scene(s)
    , log(l)
    , model(scene.bodies, scene.times)
    , history(model)
    , contact_rows(model)
    , solver(make_solver(scene.solver))
  {}

  void
  Analysis::report() const
  {
    for (std::size_t b = 0; b < scene.bodies.names.size(); ++b)
      log.say("Body " + scene.bodies.names[b] + ": " +
              scene.bodies.structures[b]->description());
    const ContactSystem &layout = model.coordinates.layout();
    log.say(std::to_string(layout.n_nodes()) + " contact nodes with " +
            std::to_string(layout.n_unknowns()) + " unknowns of " +
            std::to_string(model.coordinates.n_unknowns()) + ", " +
            std::to_string(scene.times.size()) + " increments");
    if (layout.n_nodes() == 0)
      log.note("skipped: condensation, no node may touch anything");
    Eigen::Index n_no_cone = 0;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      n_no_cone += layout.n_tangents(i) == 0;
    if (n_no_cone > 0)
      log.note("skipped: friction cones of " + std::to_string(n_no_cone) +
               " contact nodes without friction or with held tangents");
    if (model.rules.n_held_contact_nodes() > 0)
      log.note("skipped: " +
               std::to_string(model.rules.n_held_contact_nodes()) +
               " contact nodes whose normal is held by a support");
    if (model.motions.null_space().cols() > 0)
      log.note(std::to_string(model.motions.null_space().cols()) +
               " rigid motions are held by contact alone");
  }

  void
  Analysis::create_outputs(const std::filesystem::path &folder,
                           const bool                   quiet)
  {
    RunDescription run;
    run.folder       = folder;
    run.contacts     = scene.contact_names;
    run.bodies       = scene.bodies.names;
    run.structures   = scene.bodies.structures;
    run.dim          = scene.bodies.dim;
    run.n_increments = static_cast<unsigned int>(scene.times.size());
    run.vtu_every    = scene.vtu_every;
    for (const OutputRow &row : output_table())
      outputs.push_back(row.create(run));
    outputs.push_back(std::make_unique<Progress>(run, quiet));
  }

  void
  Analysis::run(const std::filesystem::path &folder, const bool quiet)
  {
    create_outputs(folder, quiet);
    for (unsigned int k = 1; k <= scene.times.size(); ++k)
      {
        const IncrementRecord record = increment(k);
        for (const auto &output : outputs)
          output->write(record);
        log.time("increment " + std::to_string(k) + " of " +
                 std::to_string(scene.times.size()) + ", " +
                 record.report.solver + ": " +
                 std::to_string(record.report.iterations) +
                 " linear solves, residual " +
                 to_text(record.report.residual) + ", equilibrium " +
                 to_text(record.equilibrium));
      }
  }

  IncrementRecord
  Analysis::increment(const unsigned int k)
  {
    IncrementRecord record;
    record.increment = k;
    record.time      = scene.times[k - 1];
    const Eigen::VectorXd forces = scene.forces(record.time);
    const Condensation   &condensation = model.condensation();
    if (k == 1)
      log.time("condensation: order, factor and Schur complement, factor of " +
               to_text(condensation.factor_bytes() / 1e6) + " MB");
    const Condensation::Load load =
      condensation.reduce(forces, model.coordinates.prescribed(record.time));

    const ContactState    state = solve_contact(load, record);
    const Eigen::VectorXd u =
      condensation.expand(load, history.displacements());
    const Equilibrium equilibrium = check_equilibrium(scene.bodies,
                                                      model.elastic,
                                                      model.coordinates,
                                                      u,
                                                      state.r,
                                                      forces,
                                                      record.time,
                                                      scene.contact_names.size(),
                                                      history.reference_force());
    history.note_force(equilibrium.largest_force);
    record.equilibrium = equilibrium.residual;
    record.balance     = equilibrium.balance;
    record.contacts    = equilibrium.contacts;
    record.supports    = equilibrium.supports;
    record.loads       = equilibrium.loads;
    if (!(record.equilibrium <= scene.solver.tolerance))
      fail(record,
           "the uncondensed equilibrium is violated by " +
             to_text(record.equilibrium) +
             " of the largest nodal force: the stiffness is too badly "
             "conditioned");
    record.rows =
      contact_rows.rows(state, history.displacements(), u, record.time);
    for (std::size_t b = 0; b < scene.bodies.structures.size(); ++b)
      record.displacements.push_back(
        u.segment(model.coordinates.offset(b),
                  scene.bodies.structures[b]->n_dofs()));
    return record;
  }

  ContactState
  Analysis::solve_contact(const Condensation::Load &load,
                          IncrementRecord          &record)
  {
    ContactState state = history.start();
    if (state.v.size() == 0)
      {
        record.report.converged = true;
        record.report.solver    = "linear";
        return state;
      }
    const ContactProblem problem = history.problem(load);
    record.report                = solver->solve(problem, state);
    record.report.residual       = contact_residual(problem, state);
    if (!record.report.converged ||
        !(record.report.residual <= scene.solver.tolerance))
      fail(record,
           record.report.reason.empty() ?
             "the residual is " + to_text(record.report.residual) :
             record.report.reason);
    record.errors = kanno_errors(problem, state);
    history.advance(state);
    return state;
  }

  void
  Analysis::fail(const IncrementRecord &record, const std::string &why) const
  {
    throw AnalysisError("Increment " + std::to_string(record.increment) +
                        " of " + std::to_string(scene.times.size()) +
                        " (t = " + to_text(record.time) + "): " + why +
                        ". The increments before it are on disk.");
  }
} // namespace conetact
