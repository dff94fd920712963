// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene.h"

#include "conetact/application/load_history.h"
#include "conetact/application/scene_text.h"
#include "conetact/application/solver_options.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/body_table.h"
#include "conetact/contact/free_obstacles.h"
#include "conetact/contact/held_nodes.h"
#include "conetact/output/problem_files.h"
#include "conetact/pairing/obstacle_table.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    std::string
    read_file(const std::filesystem::path &file)
    {
      std::ifstream      stream(file);
      std::ostringstream text;
      // Of an empty file nothing can be inserted, which is no failure to read.
      const bool is_empty = stream.peek() == std::ifstream::traits_type::eof();
      if (std::filesystem::is_directory(file) || !stream.is_open() ||
          (!is_empty && !(text << stream.rdbuf())))
        throw InputError("The scene file " + file.string() +
                         " cannot be read. Check its name and permissions.");
      // some editors begin files with a mark of their encoding
      const std::string mark = "\xef\xbb\xbf";
      const std::string all  = text.str();
      return all.rfind(mark, 0) == 0 ? all.substr(mark.size()) : all;
    }

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

    void
    declare_names(Handler &prm)
    {
      using namespace dealii::Patterns;
      prm.declare_entry("Dimension",
                        "2",
                        Selection("2|3"),
                        "Dimension of space: 2 (plane strain or stress) or 3.");
      const auto declare = [&](const std::string &list,
                               const std::string &what) {
        prm.declare_entry(list,
                          "",
                          Anything(),
                          "Names of " + what +
                            ", separated by commas; each has "
                            "its own subsection.");
      };
      declare("Bodies", "the elastic bodies");
      declare("Obstacles", "the rigid obstacles");
      declare("Contacts", "the contacts");
      declare("Supports", "the supports");
      declare("Loads", "the loads");
    }

    template <typename Declare>
    void
    declare_each(Handler                        &prm,
                 const std::string              &kind,
                 const std::vector<std::string> &names,
                 const Declare                  &declare)
    {
      for (const std::string &name : names)
        {
          prm.enter_subsection(kind + " " + name);
          declare(prm);
          prm.leave_subsection();
        }
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
  } // namespace

  Scene::Scene(const CommandLine &line)
    : file(line.scene)
    , overrides(line.overrides)
    , verifies(line.verify)
    , text(read_file(line.scene))
  {
    refuse_repeats(text, file.string());
    read_names();
    declare();
    parse_all(prm, false);
    if (bodies.names.empty())
      throw InputError("Bodies: the scene names no body. Add for example "
                       "'set Bodies = block' and 'subsection Body block'.");
    read_options();
  }

  void
  Scene::parse_all(Handler &handler, const bool skip_undefined) const
  {
    parse_scene_text(handler, text, file.string(), skip_undefined);
    for (const std::string &override : overrides)
      parse_override(handler, override, skip_undefined);
  }

  void
  Scene::read_names()
  {
    Handler lists;
    declare_names(lists);
    parse_all(lists, true);
    bodies.dim     = static_cast<unsigned int>(lists.get_integer("Dimension"));
    bodies.names   = get_names(lists, "Bodies");
    obstacle_names = get_names(lists, "Obstacles");
    contact_names  = get_names(lists, "Contacts");
    support_names  = get_names(lists, "Supports");
    load_names     = get_names(lists, "Loads");
  }

  void
  Scene::declare()
  {
    declare_names(prm);
    declare_adaptive(prm);
    declare_each(prm, "Body", bodies.names, bodies::declare_body);
    declare_each(prm, "Obstacle", obstacle_names, pairing::declare_obstacle);
    declare_each(prm, "Contact", contact_names, pairing::declare_contact);
    declare_each(prm, "Support", support_names, bodies::declare_support);
    declare_each(prm, "Load", load_names, bodies::declare_load);
    prm.enter_subsection("Time");
    declare_time(prm);
    prm.leave_subsection();
    prm.enter_subsection("Solver");
    declare_solver(prm);
    prm.declare_entry("Threads",
                      "1",
                      dealii::Patterns::Integer(0, 1024),
                      "Threads of the factorisation of the bodies' stiffness; "
                      "0: one for each core. Results do not depend on it but "
                      "for rounding.");
    prm.declare_entry("Working set",
                      "automatic",
                      dealii::Patterns::Selection("automatic|all"),
                      "Contact nodes that are condensed. automatic: those that "
                      "are likely to touch, where that saves much; as soon as "
                      "another one would penetrate it joins them, so that the "
                      "result is that of all. all: all from the start, as "
                      "where condensed problems are written, and for the load "
                      "path.");
    prm.leave_subsection();
    prm.enter_subsection("Output");
    prm.declare_entry("VTU",
                      "1",
                      dealii::Patterns::Integer(0),
                      "Write VTU files for ParaView at every n-th increment; "
                      "0: none.");
    prm.declare_entry("FCLib increments",
                      "",
                      dealii::Patterns::Anything(),
                      "Write the condensed problem of these increments "
                      "(numbers from 1 on separated by commas, or all) with "
                      "its solution as problem-0001.hdf5, ..., local problems "
                      "of FCLib; empty: none.");
    prm.declare_entry("Text increments",
                      "",
                      dealii::Patterns::Anything(),
                      "Write the condensed problem of these increments "
                      "(numbers from 1 on separated by commas, or all) as "
                      "plain text, problem-0001.txt, ..., in the units of the "
                      "scene, for conetact-reproductions or a script; of a "
                      "load path: of these stages, with its constant loads "
                      "as problem-0000.txt; empty: none.");
    prm.leave_subsection();
  }

  void
  Scene::read_options()
  {
    adaptive = create_adaptive(prm);
    prm.enter_subsection("Time");
    times = create_times(prm);
    prm.leave_subsection();
    prm.enter_subsection("Solver");
    solver    = create_solver_options(prm);
    condenser = &chosen_condenser(prm);
    path      = create_path_settings(prm);
    threads   = static_cast<unsigned int>(prm.get_integer("Threads"));
    leave_out_far_nodes =
      prm.get("Working set") == "automatic" && !path.follows;
    prm.leave_subsection();
    prm.enter_subsection("Output");
    vtu_every = static_cast<unsigned int>(prm.get_integer("VTU"));
    const auto increments_of = [&](const std::string &entry) {
      return output::parse_problem_increments(prm.get(entry),
                                              static_cast<unsigned int>(
                                                times.size()),
                                              "Output, " + entry);
    };
    fclib_increments = increments_of("FCLib increments");
    text_increments  = increments_of("Text increments");
    output::check_fclib_is_there(fclib_increments);
    prm.leave_subsection();
    leave_out_far_nodes &= fclib_increments.empty() && text_increments.empty();
    prm.enter_subsection("Solver");
    backend =
      chosen_backend(prm,
                     !fclib_increments.empty() ? "Output, FCLib increments" :
                     !text_increments.empty()  ? "Output, Text increments" :
                     verifies                  ? "the option --verify" :
                                                 "");
    prm.leave_subsection();
  }

  void
  Scene::build(const std::vector<bodies::Refinements> &refinements)
  {
    const unsigned int dim    = bodies.dim;
    const auto         folder = file.parent_path();
    create_each(prm, "Body", bodies.names, [&](const std::string &name) {
      const std::size_t b = structures.size();
      structures.push_back(bodies::create_body(prm,
                                               dim,
                                               folder,
                                               name,
                                               refinements.empty() ?
                                                 bodies::Refinements() :
                                                 refinements[b]));
      bodies.structures.push_back(structures.back().get());
    });
    create_each(prm, "Obstacle", obstacle_names, [&](const std::string &name) {
      obstacles.push_back(pairing::create_obstacle(prm, name, dim, folder));
    });
    create_each(prm, "Support", support_names, [&](const std::string &name) {
      bodies.supports.push_back(bodies::create_support(
        prm, name, dim, bodies.names, bodies.structures));
    });
    create_each(prm, "Load", load_names, [&](const std::string &name) {
      loads.push_back(
        bodies::create_load(prm, name, dim, bodies.names, bodies.structures));
    });
    create_each(prm, "Contact", contact_names, [&](const std::string &name) {
      contacts.push_back(pairing::create_contact(
        prm, name, bodies.names, bodies.structures, obstacles));
      if (dim == 2 && contacts.back().second_friction)
        throw InputError("Contact '" + name +
                         "', Second friction coefficient: "
                         "there is one tangent only in 2D. Leave it empty.");
    });
    contact_sides = contact_names;
    for (unsigned int c = 0; c < contacts.size(); ++c)
      {
        const bool pair = contacts[c].obstacle == nullptr;
        master_side.push_back(
          pair ? static_cast<unsigned int>(contact_sides.size()) : c);
        if (pair)
          contact_sides.push_back(contact_names[c] + "_master");
      }
    pairing::ContactNodes found = pairing::find_contact_nodes(contacts,
                                                              bodies.names,
                                                              bodies.structures,
                                                              dim);
    bodies.contact_nodes        = std::move(found.nodes);
    pairings                    = std::move(found.pairings);
    contact::align_with_supports(bodies);
    contact::give_up_held_nodes(bodies);
    bodies.at_rest = bodies_at_rest();
    check_path();
    check_adaptive(adaptive, bodies.structures);
    for (auto &body : contact::add_free_obstacles(obstacles, bodies))
      structures.push_back(std::move(body));
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
    return contact::forces_on_free_obstacles(obstacles, bodies, t);
  }

  std::vector<bodies::Actions>
  Scene::actions(const double t) const
  {
    std::vector<bodies::Actions> result(bodies.structures.size());
    for (const bodies::Load &load : loads)
      if (auto action = load.action(t))
        result[load.body].push_back(std::move(*action));
    return result;
  }
} // namespace conetact::application
