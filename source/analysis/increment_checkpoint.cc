// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checkpoints of increments, written and read again.

#include "conetact/analysis/checkpoint.h"
#include "conetact/analysis/increment_analysis.h"
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
    if (search.is_needed())
      {
        if (search.time() != scene.times[n_on_disk - 1])
          return;   // in parts of the next increment
        if (at_end) // the model has contacts of an increment that failed
          {
            search.go_back();
            take(search.accepted());
          }
      }
    Archive archive;
    archive.put_text("scene", scene.values());
    archive.put("times",
                std::vector<double>(scene.times.begin(),
                                    scene.times.begin() + n_on_disk));
    archive.put("one by one", one_by_one ? 1. : 0.);
    archive.put_text("backend", backend->elasticity->name);
    put_reaction_rows(archive, n_reaction_rows);
    scene.save_kinematics(archive);
    search.save(archive);
    history.save(archive);
    acceptance.save(archive);
    archive.write(description.folder / "checkpoint.bin");
    n_saved = n_on_disk;
  }

  void
  IncrementAnalysis::restore_state()
  {
    const Archive &archive = scene.restart->state;
    check_checkpoint(archive, model, scene.support_names);
    double one = 0;
    archive.fill("one by one", one);
    one_by_one      = one > 0;
    n_reaction_rows = reaction_rows_of(archive);
    output::check_former_tables(scene.restart->folder,
                                scene.n_done(),
                                n_reaction_rows);
    search.restore(archive, history);
    history.restore(archive);
    acceptance.restore(archive);
    n_saved = n_on_disk = scene.n_done();
  }
} // namespace conetact::analysis
