// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checkpoints of increments, written and read again.

#include "conetact/analysis/checkpoint.h"
#include "conetact/analysis/increment_analysis.h"
#include "conetact/analysis/stage_layout.h"
#include "conetact/base/interruption.h"
#include "conetact/base/process.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"
#include "conetact/output/former_rows.h"

namespace conetact::analysis
{
  void
  IncrementAnalysis::save_state(const bool at_end)
  {
    const unsigned int every = scene.checkpoint_every;
    if (every == 0 || n_on_disk == n_saved ||
        (!at_end && n_on_disk % every != 0 && n_on_disk != scene.times.size()))
      return;
    if (solver.search.is_needed())
      {
        if (solver.search.time() != scene.times[n_on_disk - 1])
          return;   // in parts of the next increment
        if (at_end) // the model has contacts of an increment that failed
          {
            solver.search.go_back();
            solver.must_take({solver.search.accepted()});
          }
      }
    write_checkpoint();
  }

  void
  IncrementAnalysis::write_checkpoint()
  {
    n_saved = n_on_disk;
    acceptance.gather();
    const Eigen::VectorXd elastic_start = history.elastic_start();
    agree([&] {
      if (ProcessSession::speaks())
        write_archive(elastic_start);
    });
  }

  void
  IncrementAnalysis::write_archive(const Eigen::VectorXd &elastic_start) const
  {
    Archive archive;
    archive.put_text("scene", scene.entries.values());
    archive.put("times",
                std::vector<double>(scene.times.begin(),
                                    scene.times.begin() + n_on_disk));
    archive.put("one by one", one_by_one ? 1. : 0.);
    archive.put_text("backend", backend->elasticity->name);
    put_reaction_rows(archive, n_reaction_rows);
    application::save_kinematics(scene.contacts, archive);
    solver.search.save(archive);
    history.save(elastic_start, archive);
    acceptance.save(archive);
    wear.error.save(archive);
    put_layout(model.points, archive);
    put_held_nodes(held_in_stage, archive);
    archive.write(description.folder / "checkpoint.bin");
  }

  /* Parts of the increment that is running follow first. */
  void
  IncrementAnalysis::stop_if_asked(const unsigned int next)
  {
    if (!parts.others_follow() && next <= scene.times.size() && n_on_disk > 0 &&
        wants_to_stop())
      stop();
  }

  void
  IncrementAnalysis::stop()
  {
    if (n_on_disk == 0)
      Interruption::stop("Interrupted in the first increment, which is not "
                         "found by the fast method: there are no results.");
    if (scene.checkpoint_every > 0 && n_on_disk != n_saved &&
        !parts.others_follow())
      write_checkpoint();
    Interruption::stop(interrupted());
  }

  std::string
  IncrementAnalysis::interrupted() const
  {
    const std::string folder = description.folder.string();
    return "Interrupted after increment " + std::to_string(n_on_disk) +
           ", t = " + to_text(scene.times[n_on_disk - 1]) +
           ": it and all before it are on disk in " + folder + ". " +
           (scene.checkpoint_every > 0 && n_saved > 0 ?
              "Run the same command with --restart " + folder + " to go on" +
                (n_saved < n_on_disk ?
                   " after increment " + std::to_string(n_saved) :
                   "") +
                "." :
            scene.adaptive.cycles > 0 ?
              "A scene with Adaptive refinement cannot be continued." :
            scene.follows_branches ?
              "A run with Method = all solutions cannot be continued: run it "
              "from its start." :
              "This run cannot be continued; one with Output/Checkpoint = 1 or "
              "more can, by --restart.");
  }

  void
  IncrementAnalysis::restore_state()
  {
    Archive    archive  = scene.restart->state;
    const bool is_other = take_to_layout(model, archive);
    check_checkpoint(archive, model, scene.support_names);
    double one = 0;
    archive.fill("one by one", one);
    one_by_one      = one > 0;
    n_reaction_rows = reaction_rows_of(archive);
    output::check_former_tables(scene.restart->folder,
                                scene.n_done(),
                                n_reaction_rows);
    solver.search.restore(archive, history);
    history.restore(archive);
    acceptance.restore(archive);
    if (is_other)
      acceptance.relink();
    wear.error.restore(archive);
    held_in_stage = held_nodes(archive);
    acceptance.know_held_depths(
      worn_while_held(held_in_stage, model.points.nodes()));
    n_saved = n_on_disk = scene.n_done();
  }
} // namespace conetact::analysis
