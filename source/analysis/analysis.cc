// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/analysis.h"

#include "conetact/analysis/cost.h"
#include "conetact/analysis/mesh_notices.h"
#include "conetact/analysis/scene_report.h"
#include "conetact/analysis/verify_condensation.h"
#include "conetact/base/errors.h"
#include "conetact/base/joined_warnings.h"
#include "conetact/base/process.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"
#include "conetact/output/closing.h"
#include "conetact/output/output_table.h"
#include "conetact/output/problem_files.h"
#include "conetact/output/progress.h"

#include <algorithm>
#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    /**
     * Bodies that face each other nowhere may be meant so, and are warned of;
     * throws InputError for a contact that supports leave nothing of, at any
     * time.
     */
    void
    check_empty_contacts(const application::Scene    &scene,
                         const contact::ContactModel &model,
                         Log                         &log)
    {
      std::vector<bool>        empty(scene.contact_names.size(), true);
      std::vector<std::string> sentences;
      for (const contact::ContactPoint &point : model.points.all())
        empty[point.node->contact] = false;
      for (std::size_t c = 0; c < empty.size(); ++c)
        if (empty[c] && scene.pairings[c].n_paired == 0)
          sentences.push_back(
            "contact '" + scene.contact_names[c] +
            "': nothing touches, for no node faces the master within its "
            "Reach. Check Master boundary ids and the bodies' places.");
        else if (!empty[c] || scene.n_shared[c] >= scene.pairings[c].n_paired)
          continue;
        else if (scene.stages.may_change()) // others leave it nodes
          log.note("contact " + scene.contact_names[c] +
                   ": supports or ties hold all of its nodes for a while");
        else
          throw InputError(
            "Contact '" + scene.contact_names[c] +
            "' has no node that may touch: supports or ties hold all of them along "
            "its normal. Take them out of these, or remove the contact.");
      warn(sentences, log);
    }

    /** Sides that are tied across a gap pass shear on without its couple. */
    void
    warn_of_tied_gaps(const application::Scene    &scene,
                      const contact::ContactModel &model,
                      Log                         &log)
    {
      constexpr double    large = .05; // of a cell; facets of round faces less
      std::vector<double> widest(scene.contact_names.size(), 0);
      for (std::size_t i = model.points.size(); i < model.points.all().size();
           ++i)
        {
          const pairing::ContactNode &node = *model.points.all()[i].node;
          if (node.kind == pairing::ContactKind::tie && !node.closes &&
              std::abs(node.gap) > large * node.spacing)
            widest[node.contact] =
              std::max(widest[node.contact], std::abs(node.gap));
        }
      std::vector<std::string> sentences;
      for (std::size_t c = 0; c < widest.size(); ++c)
        if (widest[c] > 0)
          sentences.push_back(
            "contact '" + scene.contact_names[c] +
            "': it binds sides that are up to " + to_text(widest[c]) +
            " apart. Forces along them make a couple, force times gap, that "
            "nothing carries. Move the bodies together, or give the contact a "
            "Gap that closes.");
      warn(sentences, log);
    }

  } // namespace

  Analysis::Analysis(const application::Scene &s, Log &l)
    : RunContext(s, l)
    , notices(scene, model)
  {
    check_empty_contacts(scene, model, log);
    warn_of_tied_gaps(scene, model, log);
    say_doubled_nodes(scene, log);
    say_what_is_not_refined(scene, log);
    notices.say_start(log);
  }

  void
  Analysis::report() const
  {
    report_sizes(scene, model, log);
  }

  void
  Analysis::estimate() const
  {
    report_cost(scene, model, *backend, log);
  }

  void
  Analysis::check_history()
  {
    for (std::size_t k = scene.n_done(); k < scene.times.size(); ++k)
      {
        const double                     t      = scene.times[k];
        const bodies::NodalLoads::Acting acting = loads.acting(t);
        model.coordinates.prescribed(t);
        // Evaluated at all times, as expressions may not be finite at some.
        refuse_unbalanced(acting.mechanical + scene.obstacle_forces(t) +
                            model.elastic.ground_forces(t),
                          t);
      }
    log.time("loads and supports at all times");
    report_loads(loads, log);
  }

  void
  Analysis::refuse_unbalanced(const Eigen::VectorXd &forces,
                              const double           t) const
  {
    constexpr double      round_off = 1e-10;
    const Eigen::MatrixXd unseen    = model.motions.unseen();
    if (unseen.cols() == 0)
      return;
    const Eigen::VectorXd driven =
      unseen.transpose() *
      (model.motions.free().transpose() * model.motions.resultants(forces));
    if (driven.norm() <= round_off * forces.lpNorm<1>())
      return;
    const contact::RigidMotions::Motion motion =
      model.motions.largest(model.motions.of_free(unseen * driven));
    throw InputError("Nothing holds " + scene.bodies.called(motion.body) +
                     " against moving " + describe(motion) +
                     ": no support, and no friction on anything that is held, "
                     "but loads drive it at t = " +
                     to_text(t) + ". " +
                     (scene.bodies.is_rigid(motion.body) ?
                        "Let it be less Free" :
                        "Add a Support") +
                     ", or friction to a Contact with what is held.");
  }

  void
  Analysis::prepare()
  {
    check_history();
    make_elasticity();
    if (!scene.fclib_increments.empty())
      output::check_problem_is_writable(*model.elasticity().system());
    if (!scene.text_increments.empty() && model.points.layout().n_nodes() == 0)
      throw InputError("Output, Text increments: no node may touch anything, "
                       "there is no contact problem. Leave the entry empty.");
  }

  void
  Analysis::verify()
  {
    verify_condensation(model,
                        *scene.condenser,
                        condensed::independent_of(*scene.condenser),
                        log);
    log.time("condensation once more, to verify it");
  }

  void
  Analysis::create_outputs(const std::filesystem::path &folder,
                           const std::size_t            n_increments,
                           const bool                   quiet)
  {
    description.folder         = folder;
    description.contacts       = scene.contact_sides;
    description.contact_bodies = scene.side_bodies;
    description.bodies         = scene.bodies.names;
    description.structures     = scene.bodies.structures;
    description.supports       = scene.support_names;
    description.loads          = scene.load_names;
    for (std::size_t k = 0; k < scene.bodies.n_free_obstacles(); ++k)
      description.obstacles.push_back(
        scene.bodies.names[scene.bodies.n_elastic() + k]);
    for (const model::Cut &cut : model.bodies.cuts)
      description.preloads.push_back(scene.contact_names[cut.contact]);
    for (unsigned int c = 0; c < scene.contact_names.size(); ++c)
      {
        const pairing::Contact &contact = scene.contacts[c];
        if (contact.layer && contact.layer->wears())
          description.wearing.push_back(c);
        if (contact.bond)
          description.breaking.push_back(c);
      }
    description.judges_uniqueness = scene.judges_uniqueness;
    description.has_moments =
      std::any_of(scene.loads.begin(),
                  scene.loads.end(),
                  [](const bodies::Load &load) {
                    return load.kind == bodies::Load::Kind::moment;
                  });
    description.follows_branches = scene.follows_branches;
    for (const bodies::Probe &probe : scene.probes)
      description.probes.push_back(probe.name);
    if (scene.restart)
      {
        description.former   = scene.restart->folder;
        description.n_former = scene.restart->n_done;
      }
    description.dim              = scene.bodies.dim;
    description.n_increments     = static_cast<unsigned int>(n_increments);
    description.end              = scene.times.empty() ? 0 : scene.times.back();
    description.vtu_every        = scene.vtu_every;
    description.units            = scene.units;
    description.fclib_increments = scene.fclib_increments;
    if (!scene.path.follows) // whose stages are no increments
      description.text_increments = scene.text_increments;
    const bool speaks = ProcessSession::speaks();
    agree([&] {
      for (const output::OutputRow &row : output::output_table())
        outputs.push_back(row.is_shared || speaks ? row.create(description) :
                                                    nullptr);
      outputs.push_back(
        speaks ? std::make_unique<output::Progress>(description, quiet) :
                 nullptr);
    });
    if (scene.restart)
      return; // its pictures begin where it goes on
    const model::IncrementRecord undeformed = acceptance.undeformed();
    for_outputs([&](output::Output &output) { output.begin(undeformed); });
  }

  /* One after the other on all processes; those that processes share agree by
     themselves. */
  void
  Analysis::for_outputs(const std::function<void(output::Output &)> &f)
  {
    for (const auto &output : outputs)
      if (output && output->is_shared())
        f(*output);
      else
        agree([&] {
          if (output)
            f(*output);
        });
  }

  std::size_t
  Analysis::most_at_once() const
  {
    // Recovering displacements of several increments in one solve is cheaper;
    // large scenes write each increment sooner.
    const Eigen::Index n = model.coordinates.n_unknowns();
    return static_cast<std::size_t>(
      std::clamp<Eigen::Index>(16000000 / std::max<Eigen::Index>(n, 1), 1, 16));
  }

  void
  Analysis::say_closing() const
  {
    // What was done before a restart is not known.
    notices.say_end((description.n_increments == 0 ||
                     n_on_disk == description.n_increments) &&
                      !scene.restart,
                    log);
    for (const std::string &line : closing_lines)
      log.say(line);
    if (log.n_warnings() > 0)
      log.say("warnings: " + std::to_string(log.n_warnings()) +
              ", above and in log.txt");
    log.say(output::files_written(description.folder));
  }

  Work
  Analysis::work() const
  {
    Work work              = done;
    work.elastic           = model.work();
    work.load_integrations = loads.n_integrations();
    work.elements          = model.elastic.n_visited();
    for (const auto &output : outputs)
      if (output)
        {
          work.outputs.drawings += output->work().drawings;
          work.outputs.table_bytes += output->work().table_bytes;
        }
    return work;
  }

  std::string
  Analysis::complete(PendingIncrement            &increment,
                     const verification::Finding &finding,
                     const contact::SharedVector &w)
  {
    const unsigned int k     = increment.record.increment;
    const bool         drawn = description.is_drawn(k) ||
                       (scene.adaptive.cycles > 0 && k == scene.times.size());
    return acceptance.complete(increment, finding, w, drawn);
  }

  void
  Analysis::write(const std::vector<model::IncrementRecord> &finished)
  {
    if (finished.empty())
      return;
    log.time("contact, displacements and equilibrium of " +
             std::to_string(finished.size()) + " increments");
    for_outputs([&](output::Output &output) { output.write(finished); });
    if (scene.adaptive.cycles > 0)
      final_record = finished.back();
    for (const model::IncrementRecord &record : finished)
      notices.see(record);
    closing_lines =
      output::closing_lines(description, finished.back(), notices.faceted());
    n_on_disk = finished.back().increment;
    log.time("their tables and drawings");
    for (const model::IncrementRecord &record : finished)
      log.note(name(record) + ", " + record.report.solver + ": " +
               std::to_string(record.report.iterations) +
               " linear solves, residual " + to_text(record.report.residual) +
               ", equilibrium " + to_text(record.equilibrium) +
               (record.pairings > 0 ?
                  ", contacts found again " + std::to_string(record.pairings) +
                    " times" :
                  ""));
  }

  std::string
  Analysis::failed(const model::IncrementRecord &record,
                   const std::string            &why) const
  {
    return name(record) + " (t = " + to_text(record.time) + "): " + why + "." +
           (record.increment > 1 ? " The increments before it are on disk." :
                                   "");
  }
} // namespace conetact::analysis
