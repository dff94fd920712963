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

    template <typename Create>
    void
    create_each(Handler                        &prm,
                const std::string              &kind,
                const std::vector<std::string> &names,
                const Create                   &create)
    {
      for (const std::string &name : names)
        {
          prm.enter_subsection(kind + " " + name);
          create(name);
          prm.leave_subsection();
        }
    }

    /** Which load knows the density of its body. */
    void
    take_densities(const std::vector<double>      &densities,
                   const std::vector<std::string> &bodies,
                   std::vector<bodies::Load>      &loads)
    {
      for (bodies::Load &load : loads)
        if (load.density = densities[load.body];
            load.kind == bodies::Load::Kind::centrifugal && load.density == 0)
          throw InputError("Load '" + load.name +
                           "', Kind: a centrifugal load needs the Density in "
                           "the Material of body '" +
                           bodies[load.body] + "'.");
    }

    /** In this stage. */
    void
    release_inactive(const std::vector<bool>      &active,
                     std::vector<bodies::Support> &supports)
    {
      AssertDimension(active.size(), supports.size());
      for (std::size_t k = 0; k < active.size(); ++k)
        if (!active[k])
          supports[k].release();
    }

    /** Contacts have a side, those of two bodies another one behind all. */
    void
    name_sides(const std::vector<pairing::Contact> &contacts, Scene &scene)
    {
      scene.contact_sides = scene.contact_names;
      for (const pairing::Contact &contact : contacts)
        scene.side_bodies.push_back(contact.body);
      for (unsigned int c = 0; c < contacts.size(); ++c)
        {
          const bool pair = contacts[c].obstacle == nullptr;
          scene.master_side.push_back(
            pair ? static_cast<unsigned int>(scene.contact_sides.size()) : c);
          if (pair)
            {
              scene.contact_sides.push_back(scene.contact_names[c] + "_master");
              scene.side_bodies.push_back(contacts[c].master);
            }
        }
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

  void
  Scene::build(const std::vector<bodies::Refinements> &refinements)
  {
    const unsigned int  dim    = bodies.dim;
    const auto          folder = file.parent_path();
    std::vector<double> densities; // of each body
    create_each(prm, "Body", bodies.names, [&](const std::string &name) {
      const std::size_t b = structures.size();
      structures.push_back(bodies::create_body(prm,
                                               dim,
                                               folder,
                                               name,
                                               refinements.empty() ?
                                                 bodies::Refinements() :
                                                 refinements[b]));
      if (adaptive.cycles == 0)
        structures.back()->forget_mesh();
      prm.enter_subsection("Material");
      densities.push_back(prm.get_double("Density"));
      prm.leave_subsection();
      bodies.structures.push_back(structures.back().get());
    });
    obstacles.reserve(obstacle_names.size() + load_names.size()); // stay there
    create_each(prm, "Obstacle", obstacle_names, [&](const std::string &name) {
      obstacles.push_back(pairing::create_obstacle(prm, name, dim, folder));
    });
    create_each(prm, "Support", support_names, [&](const std::string &name) {
      bodies.supports.push_back(bodies::create_support(
        prm, name, dim, bodies.names, bodies.structures));
    });
    release_inactive(active_supports(times.back()), bodies.supports);
    create_each(prm, "Load", load_names, [&](const std::string &name) {
      loads.push_back(
        bodies::create_load(prm, name, dim, bodies.names, bodies.structures));
    });
    take_densities(densities, bodies.names, loads);
    add_weights(densities);
    create_each(prm, "Contact", contact_names, [&](const std::string &name) {
      add_contact(prm, name, "Contact '" + name + "', ");
    });
    if (finds_contacts)
      add_automatic_contacts();
    const std::vector<std::string> couplings = add_couplings();
    if (dim == 2)
      check_axisymmetric(bodies.names, bodies.structures, obstacles, contacts);
    hold_axes(bodies);
    name_sides(contacts, *this);
    check_turning_supports();
    pair_contacts();
    keep_nodes();
    contact::give_up_held_nodes(bodies);
    bodies.at_rest = bodies_at_rest();
    prm.enter_subsection("Output");
    probes = bodies::parse_probes(prm.get("Probes"),
                                  dim,
                                  bodies.names,
                                  bodies.structures,
                                  "Output, Probes");
    prm.leave_subsection();
    settle_friction();
    check_path();
    check_adaptive(adaptive, bodies.structures);
    for (auto &body : contact::add_free_obstacles(obstacles, bodies))
      structures.push_back(std::move(body));
    act_on_couplings(couplings);
    check_preloads();
    for (auto &body : contact::add_preloads(contacts, bodies))
      structures.push_back(std::move(body));
  }

  void
  Scene::add_weights(const std::vector<double> &densities)
  {
    const std::string given = prm.get("Gravity");
    if (given.empty())
      return;
    const Tensor<1, 3> gravity = to_vector(given, bodies.dim, "Gravity");
    if (bodies.are_axisymmetric() && gravity[0] != 0)
      throw InputError("Gravity: " + given +
                       " has a component across the axis "
                       "of the bodies of revolution, y. Give 0 for x.");
    for (unsigned int b = 0; b < densities.size(); ++b)
      if (densities[b] > 0)
        {
          load_names.push_back("weight " + bodies.names[b]);
          loads.push_back(bodies::weight_of(
            b, load_names.back(), densities[b], gravity, bodies.dim));
        }
    if (std::all_of(densities.begin(), densities.end(), [](const double d) {
          return d == 0;
        }))
      throw InputError("Gravity: no body has a weight. Set Density in the "
                       "Material of those that have one, or leave the entry "
                       "empty.");
  }

  void
  Scene::add_contact(Handler           &entries,
                     const std::string &name,
                     const std::string &in)
  {
    if (pairing::adjusts_gaps(entries))
      adjusted_contacts.push_back(static_cast<unsigned int>(contacts.size()));
    contacts.push_back(pairing::create_contact(entries,
                                               name,
                                               in,
                                               bodies.dim,
                                               bodies.names,
                                               bodies.structures,
                                               obstacles));
    if (path.follows)
      pairing::take_cohesion_of_path(entries, in, contacts.back());
    kinematics.push_back({pairing::read_kinematics(entries), {}, {}, {}});
    if (bodies.dim == 2 && contacts.back().friction->is_elliptic())
      throw InputError(in + "Second friction coefficient: there is one tangent "
                            "only in 2D. Leave it empty.");
  }

  void
  Scene::add_automatic_contacts()
  {
    if (!near_sides)
      near_sides = find_near_sides(prm,
                                   bodies.names,
                                   bodies.structures,
                                   obstacles,
                                   named_sides(prm, contact_names));
    for (const WrittenContact &contact :
         write_contacts(prm, *near_sides, bodies.names, obstacles))
      {
        if (std::find(contact_names.begin(),
                      contact_names.end(),
                      contact.name) != contact_names.end())
          throw InputError("Contacts: automatic finds a contact '" +
                           contact.name +
                           "', and there is one of that name. Give yours "
                           "another name.");
        contact_names.push_back(contact.name);
        add_contact(*contact.entries, contact.name, in_automatic);
        automatic_text += contact.text();
      }
    automatic_text =
      "set Contacts = " + join(contact_names) + '\n' + automatic_text;
  }

  void
  Scene::check_preloads() const
  {
    for (const pairing::Contact &contact : contacts)
      {
        if (!contact.preload || !contact.preload->locked_from)
          continue;
        const double      from = *contact.preload->locked_from;
        const std::string in =
          "Contact '" + contact.name + "', Preload locked from: ";
        if (from <= 0)
          throw InputError(in + "the force acts up to t = " + to_text(from) +
                           ", which is never. Give the end of the increment "
                           "in which it has tightened the bolt.");
        if (!times.empty() && from < times.back() &&
            std::none_of(times.begin(), times.end(), [from](const double t) {
              return std::abs(t - from) <= 1e-12 * std::abs(from);
            }))
          throw InputError(in + "no increment ends at t = " + to_text(from) +
                           ". Give the end of one, or choose other Times.");
      }
  }

  std::vector<bool>
  Scene::bodies_at_rest() const
  {
    std::vector<bool> at_rest(bodies.structures.size(), true);
    for (const bodies::Load &load : loads)
      if (!load.is_zero())
        at_rest[load.body] = false;
    for (const bodies::Support &support : bodies.supports)
      if (!support.is_still())
        at_rest[support.body] = false;
    for (const pairing::Contact &contact : contacts) // also one that stays open
      {
        at_rest[contact.body] = false;
        if (contact.obstacle == nullptr)
          at_rest[contact.master] = false;
      }
    return at_rest;
  }

  void
  Scene::keep_nodes()
  {
    const auto keep = [&](const unsigned int body, const auto &ids) {
      const bodies::Surface surface = bodies.structures[body]->surface(ids);
      for (const bodies::SurfaceNode &node : surface.nodes)
        bodies.nodes_to_keep.emplace_back(body, node.node);
      for (const bodies::SurfaceFace &face : surface.faces) // hanging ones, too
        for (const unsigned int node : face.nodes)
          bodies.nodes_to_keep.emplace_back(body, node);
    };
    for (const pairing::Contact &contact : contacts)
      if (contact.slides)
        {
          keep(contact.body, contact.ids);
          if (contact.obstacle == nullptr)
            keep(contact.master, contact.master_ids);
        }
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
