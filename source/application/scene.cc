// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene.h"

#include "conetact/contact/free_obstacles.h"
#include "conetact/contact/preloads.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::application
{
  Scene::Scene(const CommandLine &line)
    : entries(line)
    , contact_names(entries.names.contacts)
    , support_names(entries.names.supports)
    , load_names(entries.names.loads)
  {
    bodies.dim                        = entries.dim;
    bodies.names                      = entries.names.bodies;
    static_cast<RunSettings &>(*this) = read_settings(entries.prm);
    stages = Stages(entries.prm, support_names, *this);
    refuse_checkpoints(*this);
    if (!line.restart.empty())
      restart = continue_from(line.restart, entries.values(), *this);
    read_problem_increments(entries.prm, line.verify, *this);
  }

  pairing::SlidingContacts
  Scene::sliding_contacts() const
  {
    return pairing::SlidingContacts(contacts,
                                    bodies.structures,
                                    bodies.contact_nodes,
                                    bodies.dim);
  }

  bodies::NodalLoads
  Scene::nodal_loads() const
  {
    return bodies::NodalLoads(loads, bodies.structures, bodies.dim);
  }

  Eigen::VectorXd
  Scene::obstacle_forces(const double t) const
  {
    Eigen::VectorXd f = contact::forces_on_free_obstacles(obstacles, bodies, t);
    contact::add_preload_forces(contacts, bodies, t, f);
    return f;
  }

  std::vector<bodies::Actions>
  Scene::actions(const double t) const
  {
    std::vector<bodies::Actions> result(bodies.structures.size());
    for (const bodies::Load &load : loads)
      if (auto action = load.is_active(t) ? load.action(t) : std::nullopt)
        result[load.body].push_back(std::move(*action));
    return result;
  }

  void
  Scene::take_stage(const double end, const std::filesystem::path &folder)
  {
    Assert(!times.empty() && end >= times.front(),
           dealii::ExcMessage("A stage has a time at least."));
    times.erase(std::remove_if(times.begin(),
                               times.end(),
                               [end](const double t) { return t > end; }),
                times.end());
    if (checkpoint_every == 0) // at its end only
      checkpoint_every = static_cast<unsigned int>(times.size());
    if (folder.empty())
      return;
    const bool continues_other = restart.has_value();
    restart                    = continue_from(folder, entries.values(), *this);
    restart->is_of_this_run    = !continues_other;
  }
} // namespace conetact::application
