// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/scene_report.h"

#include "conetact/analysis/cost.h"
#include "conetact/base/joined_warnings.h"
#include "conetact/base/process.h"
#include "conetact/base/text.h"
#include "conetact/bodies/groups.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    void
    report_pairing(const std::string      &name,
                   const pairing::Pairing &found,
                   const unsigned int      n_shared,
                   Log                    &log)
    {
      const unsigned int n_free = found.n_nodes - found.n_paired;
      std::string        text   = "Contact " + name + ": " +
                         std::to_string(found.n_nodes) + " nodes, " +
                         std::to_string(found.n_paired) + " paired";
      if (found.n_paired > 0)
        text += ", gaps from " + to_text(found.least_gap) + " to " +
                to_text(found.largest_gap);
      if (n_free > 0)
        text += ", " + std::to_string(n_free) +
                " face no master within reach and stay free";
      if (n_shared > 0)
        text += ", " + std::to_string(n_shared) +
                (n_shared == 1 ? " of them is" : " of them are") +
                " also in a contact before it, along the same normal: rows "
                "of that contact have the reactions of both there";
      log.note(text);
    }

    /** What holds of a contact, and why. */
    void
    report_kinematics(const pairing::Contact           &contact,
                      const pairing::ContactKinematics &kinematics,
                      Log                              &log)
    {
      std::string text = "Contact " + contact.name + ": kinematics " +
                         (contact.slides ? "finite sliding" : "small");
      if (contact.kind == pairing::ContactKind::tie)
        text += contact.obstacle != nullptr ?
                  ", a tie" :
                  ", a tie, which turns with its bodies";
      else if (kinematics.asked != pairing::Kinematics::automatic)
        text += ", as asked for";
      else if (kinematics.why_finite.empty())
        text += kinematics.why_not_plane.empty() ?
                  ", both sides are plane" :
                  ", until that is wrong (" + kinematics.why_not_plane +
                    ": finite sliding would follow that)";
      else
        text += ": " + kinematics.why_finite +
                (contact.slides ? "" : ", but " + kinematics.why_not_finite);
      log.note(text);
    }

    void
    warn_of_idle_obstacles(const application::Scene &scene, Log &log)
    {
      std::vector<std::string> sentences;
      for (const pairing::Obstacle *obstacle : scene.idle_obstacles())
        sentences.push_back(
          "Contacts = automatic: obstacle '" + obstacle->name +
          "' is in no contact, bodies pass through it. " +
          (obstacle->shape->states_gaps() ?
             "Shape = prescribed gap does not say where it is: write "
             "a Contact for it." :
             "Set Automatic contact/Largest gap to what is between it "
             "and the body that is to touch it."));
      warn(sentences, log);
    }

    /** What `Contacts = automatic` has found, and how a scene would say it. */
    void
    report_automatic(const application::Scene &scene, Log &log)
    {
      if (!scene.near_sides)
        return;
      warn_of_idle_obstacles(scene, log);
      if (scene.near_sides->sides.empty())
        {
          log.say(
            "warning: Contacts = automatic: no two bodies have faces that "
            "oppose each other nearby. Set Automatic contact/Largest gap "
            "to what is between those that are to touch.");
          return;
        }
      const std::size_t n = scene.near_sides->sides.size();
      log.say("Contacts = automatic: " + std::to_string(n) +
              (n == 1 ? " pair: " : " pairs: ") +
              join(std::vector<std::string>(scene.contact_names.end() -
                                              static_cast<std::ptrdiff_t>(n),
                                            scene.contact_names.end())));
      for (const std::string &line : split(scene.automatic_text, '\n'))
        log.note(line);
    }

    void
    warn_of_memory(const double bytes, Log &log)
    {
      if (bytes > machine_memory())
        log.say("warning: this machine has " + megabytes(machine_memory()) +
                " of memory only. Use a coarser mesh or fewer contact nodes.");
    }

    double
    memory_of_all(const int n, const Cost &cost)
    {
      return cost.memory_bytes + (n - 1) * cost.memory_of_others;
    }
    double
    seconds_of_all(const int n, const Cost &cost)
    {
      return cost.seconds + (n - 1) * cost.seconds_of_others;
    }

    std::string
    tenths(const double seconds)
    {
      return to_text(std::round(10 * seconds) / 10) + " s";
    }

    /** Of many processes, where n of them share the work. */
    void
    report_processes(const int n, const Cost &cost, Log &log)
    {
      if (n > 1)
        log.say("estimate: " + std::to_string(n) +
                " processes, the first one " + megabytes(cost.memory_bytes) +
                " and " + tenths(cost.seconds) + " of CPU, each other one " +
                megabytes(cost.memory_of_others) + " and " +
                tenths(cost.seconds_of_others));
    }

    /** Of condensed bodies. */
    void
    report_factor(const application::Scene &scene,
                  const Cost               &cost,
                  const std::string        &memory,
                  const std::string        &time,
                  Log                      &log)
    {
      report_shared_bodies(scene.bodies, cost.factor->n_shared, log);
      log.say("estimate: factor of " + megabytes(cost.factor->factor_bytes) +
              ", condensed stiffness of " + megabytes(cost.stiffness_bytes) +
              ", memory of " + memory + " in all");
      log.say("estimate: " + to_text(cost.factor->flops) +
              " floating-point operations to factorise, " + time + " in all");
      if (scene.condenser != &condensed::default_condenser())
        log.say("estimate: at least, for " +
                std::string(scene.condenser->name) +
                " tells nothing before it is done");
    }

    void
    report_bodies(const application::Scene &scene, Log &log)
    {
      const model::Bodies &bodies = scene.bodies;
      for (std::size_t b = 0; b < bodies.names.size(); ++b)
        if (b < bodies.n_elastic() + bodies.n_free_obstacles())
          log.say((bodies.is_rigid(b) ? "Obstacle " : "Body ") +
                  bodies.names[b] + ": " + bodies.structures[b]->description());
      for (const model::Cut &cut : bodies.cuts)
        log.say("Preload of contact " + scene.contact_names[cut.contact] +
                ": along " + to_text(cut.axis) +
                (cut.locked_from ?
                   ", locked from t = " + to_text(*cut.locked_from) :
                   ""));
      warn(scene.cautions(), log);
      for (std::size_t b = 0; b < bodies.names.size(); ++b)
        if (bodies.is_at_rest(b))
          log.note(
            "skipped: " + std::to_string(bodies.structures[b]->n_dofs()) +
            " dofs of body " + bodies.names[b] +
            ", which no load, support motion or contact reaches");
      std::vector<std::string> cautions;
      for (std::size_t b = 0; b < bodies.names.size(); ++b)
        if (const std::string caution = bodies.structures[b]->caution();
            !caution.empty())
          cautions.push_back("body '" + bodies.names[b] + "': " + caution);
      warn(cautions, log);
      for (std::size_t b = 0; b < bodies.names.size(); ++b)
        if (const auto [elements, matrices] =
              bodies.structures[b]->elements().count();
            matrices < elements)
          log.note("skipped: " + std::to_string(elements - matrices) + " of " +
                   std::to_string(elements) + " cell matrices of body " +
                   bodies.names[b] + ", congruent to others");
    }

    /** "plane with normal (0, 0, 1)" if all faces have one normal. */
    std::string
    shape_of(const std::vector<bodies::SurfaceFace> &faces)
    {
      const Tensor<1, 3> normal = faces.front().normal;
      const bool         is_plane =
        std::all_of(faces.begin(), faces.end(), [&](const auto &face) {
          return (face.normal - normal).norm() < 1e-6;
        });
      return is_plane ? "plane with normal " + to_text(normal) : "not plane";
    }

    /** What to write for the id, and the groups that it is part of. */
    std::string
    id_and_groups(const bodies::Structure &body, const unsigned int id)
    {
      const auto              &groups  = body.boundary_groups();
      const std::string        written = bodies::name_of(id, groups);
      std::vector<std::string> names;
      for (const auto &[name, ids] : groups)
        if (ids.count(id) > 0 && name != written)
          names.push_back(name);
      return written + (names.empty() ? "" : " (" + join(names) + ")");
    }

    void
    report_boundary(const std::string       &name,
                    const bodies::Structure &body,
                    const unsigned int       id,
                    Log                     &log)
    {
      const bodies::Surface surface = body.surface({id});
      if (surface.faces.empty())
        return;
      double                area = 0;
      std::vector<Point<3>> points;
      for (const bodies::SurfaceNode &node : surface.nodes)
        {
          area += node.area;
          points.push_back(node.position);
        }
      const auto [low, high] =
        dealii::BoundingBox<3>(points).get_boundary_points();
      log.note("Body " + name + ", boundary id " + id_and_groups(body, id) +
               ": area " + to_text(area) + ", " + shape_of(surface.faces) +
               ", from " + to_text(low) + " to " + to_text(high));
    }

    void
    report_skipped(const application::Scene    &scene,
                   const contact::ContactModel &model,
                   Log                         &log)
    {
      const solvers::ContactSystem &layout    = model.points.layout();
      Eigen::Index                  n_no_cone = 0;
      for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
        n_no_cone += layout.n_tangents(i) == 0;
      if (n_no_cone > 0)
        log.note("skipped: friction cones of " + std::to_string(n_no_cone) +
                 " contact nodes without friction or with held tangents");
      if (model.points.traits().n_held > 0)
        log.note("skipped: " + std::to_string(model.points.traits().n_held) +
                 " contact nodes whose normal is held by a support");
      if (!scene.path.follows && scene.n_drawings() < scene.times.size())
        log.note("skipped: drawings of " +
                 std::to_string(scene.times.size() - scene.n_drawings()) +
                 " of " + std::to_string(scene.times.size()) + " increments");
      if (model.motions.null_space().cols() > 0)
        log.note(std::to_string(model.motions.null_space().cols()) +
                 " rigid motions are held by contact alone");
    }
  } // namespace

  void
  report_shared_bodies(const model::Bodies &bodies,
                       const unsigned int   n_shared,
                       Log                 &log)
  {
    const auto n_at_rest =
      std::count(bodies.at_rest.begin(), bodies.at_rest.end(), true);
    if (n_shared > 0)
      log.note("skipped: condensation of " + std::to_string(n_shared) + " of " +
               std::to_string(bodies.names.size() -
                              static_cast<std::size_t>(n_at_rest)) +
               " bodies, equal to others");
  }

  void
  report_sizes(const application::Scene    &scene,
               const contact::ContactModel &model,
               Log                         &log)
  {
    for (const std::string &sentence : scene.entries.left_out)
      log.note(sentence);
    report_bodies(scene, log);
    report_automatic(scene, log);
    const solvers::ContactSystem &layout = model.points.layout();
    log.say(std::to_string(layout.n_nodes()) + " contact nodes with " +
            std::to_string(layout.n_unknowns()) + " unknowns of " +
            std::to_string(model.coordinates.n_unknowns()) + ", " +
            std::to_string(scene.times.size()) + " increments");
    if (model.points.n_bound() > 0)
      log.say(std::to_string(model.points.n_bound()) + " nodes bound by " +
              std::to_string(model.points.n_bound_unknowns()) +
              " equations of ties and bilateral contacts");
    if (model.points.all().empty())
      log.note("skipped: condensation, no node may touch anything");
    for (std::size_t c = 0; c < scene.pairings.size(); ++c)
      {
        report_pairing(scene.contact_names[c],
                       scene.pairings[c],
                       scene.n_shared[c],
                       log);
        report_kinematics(scene.contacts[c], scene.kinematics[c], log);
      }
    report_skipped(scene, model, log);
  }


  void
  report_boundaries(const model::Bodies &bodies, Log &log)
  {
    for (std::size_t b = 0; b < bodies.n_elastic(); ++b)
      for (const unsigned int id : bodies.structures[b]->boundary_ids())
        report_boundary(bodies.names[b], *bodies.structures[b], id, log);
  }


  void
  report_meshes(const model::Bodies &bodies, Log &log)
  {
    for (std::size_t b = 0; b < bodies.n_elastic(); ++b)
      log.say("Body " + bodies.names[b] + ": " +
              bodies.structures[b]->description());
    report_boundaries(bodies, log);
  }


  void
  report_loads(const bodies::NodalLoads &loads, Log &log)
  {
    for (std::size_t i = 0; i < loads.largest().size(); ++i)
      {
        const bodies::NodalLoads::Largest &load = loads.largest()[i];
        const bool is_couple = load.force.norm() == 0 && load.moment.norm() > 0;
        const std::string asked = loads.asked(i);
        log.note("Load " + load.name +
                 (is_couple ? ": moment " + to_text(load.moment) :
                              ": resultant " + to_text(load.force)) +
                 (load.is_constant ? " at all times" :
                                     " at t = " + to_text(load.time)) +
                 ", on " + std::to_string(load.n_nodes) + " nodes" +
                 (asked.empty() ? "" : ", " + asked));
      }
  }


  void
  report_cost(const application::Scene    &scene,
              const contact::ContactModel &model,
              const Backend               &backend,
              Log                         &log)
  {
    const int  n = backend.useful_processes(scene, model);
    const Cost cost =
      backend.estimate(model, scene.times.size(), scene.n_drawings(), n);
    const double      all    = memory_of_all(n, cost);
    const std::string memory = megabytes(all);
    const std::string time   = tenths(seconds_of_all(n, cost));
    if (cost.factor)
      report_factor(scene, cost, memory, time, log);
    else
      log.say("estimate: backend " + std::string(backend.elasticity->name) +
              ", memory of " + memory + ", " + time + " in all");
    report_processes(n, cost, log);
    warn_of_memory(all, log);
  }


  void
  report_skips(const application::Scene &scene,
               contact::ContactModel    &model,
               const bodies::NodalLoads &loads,
               Log                      &log)
  {
    const auto n_increments = static_cast<unsigned int>(scene.times.size());
    const auto note         = [&log](const unsigned int n_done,
                             const unsigned int n_all,
                             const char        *what) {
      if (n_done < n_all)
        log.note("skipped: " + std::to_string(n_all - n_done) + " of " +
                 std::to_string(n_all) + " " + what);
    };
    if (!model.elasticity().system()->large)
      note(std::max(model.work().factorizations, 1u), // of small bodies: none
           n_increments,
           "factorisations, the stiffness stays the same");
    note(model.elasticity().n_reductions(),
         n_increments,
         "load cases, combinations of others or bodies carried along");
    note(loads.n_integrations(),
         loads.n_evaluations(),
         "integrations of loads, known already");
  }
} // namespace conetact::analysis
