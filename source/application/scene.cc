// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene.h"

#include "conetact/application/axisymmetry.h"
#include "conetact/application/load_history.h"
#include "conetact/application/scene_entries.h"
#include "conetact/application/scene_text.h"
#include "conetact/application/solver_options.h"
#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/body_table.h"
#include "conetact/contact/free_obstacles.h"
#include "conetact/contact/held_nodes.h"
#include "conetact/contact/preloads.h"
#include "conetact/output/problem_files.h"
#include "conetact/pairing/adjusted_gaps.h"
#include "conetact/pairing/obstacle_table.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    std::vector<std::string>
    get_names(Handler &prm, const std::string &list)
    {
      std::vector<std::string> names = split(prm.get(list), ',');
      std::set<std::string>    seen;
      for (const std::string &name : names)
        if (name.empty())
          throw InputError(list + ": a name is missing beside a comma. "
                                  "Remove the comma, or add the name.");
        else if (!seen.insert(name).second)
          throw InputError(list + ": '" + name +
                           "' stands there twice. Give each one its own name.");
      return names;
    }
  } // namespace

  Scene::Scene(const CommandLine &line)
    : file(line.scene)
    , overrides(line.overrides)
    , verifies(line.verify)
    , text(read_scene_file(line.scene))
  {
    refuse_repeats(text);
    left_out = leave_out_unlisted(text, overrides);
    read_names();
    declare_scene(
      prm,
      {bodies.names, obstacle_names, contact_names, support_names, load_names});
    parse_all(prm, false);
    if (!finds_contacts)
      refuse_idle_automatic_contact(prm);
    if (bodies.names.empty())
      throw InputError("Bodies: the scene names no body. Add for example "
                       "'set Bodies = block' and 'subsection Body block'.");
    read_options();
    read_activity();
    refuse_checkpoints();
    if (!line.restart.empty())
      continue_from(line.restart);
    read_problem_increments();
  }

  void
  Scene::parse_all(Handler &handler, const bool skip_undefined) const
  {
    parse_scene_text(handler, text, skip_undefined);
    for (const std::string &override : overrides)
      parse_override(handler, override, skip_undefined);
  }

  void
  Scene::read_names()
  {
    Handler lists;
    declare_lists(lists);
    parse_all(lists, true);
    bodies.dim     = static_cast<unsigned int>(lists.get_integer("Dimension"));
    bodies.names   = get_names(lists, "Bodies");
    obstacle_names = get_names(lists, "Obstacles");
    contact_names  = get_names(lists, "Contacts");
    const auto at =
      std::find(contact_names.begin(), contact_names.end(), automatic_contacts);
    finds_contacts = at != contact_names.end();
    if (finds_contacts)
      contact_names.erase(at);
    support_names = get_names(lists, "Supports");
    load_names    = get_names(lists, "Loads");
  }

  void
  Scene::read_options()
  {
    adaptive = create_adaptive(prm);
    prm.enter_subsection("Time");
    replace_times();
    times = create_times(prm);
    prm.leave_subsection();
    prm.enter_subsection("Solver");
    solver         = create_solver_options(prm);
    condenser      = &chosen_condenser(prm);
    preconditioner = iterative::preconditioner_named(prm.get("Preconditioner"));
    path           = create_path_settings(prm);
    follows_branches = application::follows_branches(prm);
    threads          = static_cast<unsigned int>(prm.get_integer("Threads"));
    prm.leave_subsection();
    prm.enter_subsection("Output");
    vtu_every        = static_cast<unsigned int>(prm.get_integer("VTU"));
    units            = {prm.get("Units"), "Output, Units"};
    checkpoint_every = static_cast<unsigned int>(prm.get_integer("Checkpoint"));
    prm.leave_subsection();
  }

  /* Times of the command line stand in place of those of the file, and these
     in place of those that it includes. */
  void
  Scene::replace_times()
  {
    constexpr int nowhere = std::numeric_limits<int>::max();
    const auto    depth   = [this](const std::string &entry) {
      const std::string key = "Time/" + entry;
      if (std::any_of(overrides.begin(),
                      overrides.end(),
                      [&key](const std::string &override) {
                        return sets(override, key);
                      }))
        return -1;
      const auto line = place_of(text, key);
      return line ? static_cast<int>(text.origins[*line].depth) : nowhere;
    };
    for (const char *list : {"Times", "Stages"})
      for (const char *entry : {"End", "Increments"})
        if (!prm.get(list).empty() && depth(list) < depth(entry))
          prm.set(entry, "1");
  }

  void
  Scene::read_problem_increments()
  {
    prm.enter_subsection("Output");
    const auto increments_of = [&](const std::string &entry) {
      return output::parse_problem_increments(prm.get(entry),
                                              static_cast<unsigned int>(
                                                times.size()),
                                              "Output, " + entry);
    };
    fclib_increments = increments_of("FCLib increments");
    text_increments  = increments_of("Text increments");
    output::check_fclib_is_there(fclib_increments);
    judges_uniqueness = prm.get("Uniqueness") == "yes";
    prm.leave_subsection();
    prm.enter_subsection("Solver");
    backend =
      chosen_backend(prm,
                     judges_uniqueness         ? "Output, Uniqueness" :
                     !fclib_increments.empty() ? "Output, FCLib increments" :
                     !text_increments.empty()  ? "Output, Text increments" :
                     verifies                  ? "the option --verify" :
                                                 "");
    prm.leave_subsection();
  }

  pairing::SlidingContacts
  Scene::sliding_contacts() const
  {
    return pairing::SlidingContacts(contacts,
                                    bodies.structures,
                                    bodies.contact_nodes,
                                    bodies.dim);
  }

  std::string
  Scene::documentation() const
  {
    std::ostringstream stream;
    prm.print_parameters(stream, Handler::Text);
    return stream.str();
  }

  std::string
  Scene::values() const
  {
    std::ostringstream stream;
    prm.print_parameters(stream, Handler::ShortText);
    return stream.str();
  }

  std::vector<EntryDescription>
  Scene::entries() const
  {
    return list_entries(prm);
  }

  std::string
  Scene::name() const
  {
    return file.stem().string();
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
} // namespace conetact::application
