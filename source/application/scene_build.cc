// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a scene is made of, from its entries.

#include "conetact/application/axisymmetry.h"
#include "conetact/application/method_checks.h"
#include "conetact/application/scene.h"
#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/body_table.h"
#include "conetact/contact/common_turns.h"
#include "conetact/contact/free_obstacles.h"
#include "conetact/contact/free_spins.h"
#include "conetact/contact/held_nodes.h"
#include "conetact/contact/preloads.h"
#include "conetact/pairing/adjusted_gaps.h"
#include "conetact/pairing/obstacle_table.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

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

    /** Those that nothing reaches. */
    std::vector<bool>
    bodies_at_rest(const SceneObjects &scene)
    {
      std::vector<bool> at_rest(scene.bodies.structures.size(), true);
      for (const bodies::Load &load : scene.loads)
        if (!load.is_zero())
          at_rest[load.body] = false;
      for (const bodies::Support &support : scene.bodies.supports)
        if (!support.is_still())
          at_rest[support.body] = false;
      // also by a contact that stays open
      for (const pairing::Contact &contact : scene.contacts)
        {
          at_rest[contact.body] = false;
          if (contact.obstacle == nullptr)
            at_rest[contact.master] = false;
        }
      return at_rest;
    }

    /** Those of sides that slide. */
    void
    keep_nodes(const std::vector<pairing::Contact> &contacts,
               model::Bodies                       &bodies)
    {
      const auto keep = [&](const unsigned int body, const auto &ids) {
        const bodies::Surface surface = bodies.structures[body]->surface(ids);
        for (const bodies::SurfaceNode &node : surface.nodes)
          bodies.nodes_to_keep.emplace_back(body, node.node);
        // hanging ones, too
        for (const bodies::SurfaceFace &face : surface.faces)
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
  } // namespace

  void
  Scene::build(const std::vector<bodies::Refinements> &refinements)
  {
    create_objects(refinements);
    const std::vector<std::string> couplings = add_couplings();
    if (bodies.dim == 2)
      check_axisymmetric(bodies.names, bodies.structures, obstacles, contacts);
    hold_axes(bodies);
    name_sides(contacts, *this);
    check_turning_supports(*this, *this);
    bodies.round_sides =
      contact::find_free_spins(contacts, loads, times, bodies);
    find_contact_nodes();
    bodies.at_rest = bodies_at_rest(*this);
    entries.prm.enter_subsection("Output");
    probes = bodies::parse_probes(entries.prm.get("Probes"),
                                  bodies.dim,
                                  bodies.names,
                                  bodies.structures,
                                  "Output, Probes");
    entries.prm.leave_subsection();
    settle_friction(*this, *this);
    check_path(*this, *this);
    check_adaptive(adaptive, bodies.structures);
    for (auto &body : contact::add_free_obstacles(obstacles, bodies))
      structures.push_back(std::move(body));
    act_on_couplings(couplings);
    check_preloads(*this, times);
    for (auto &body : contact::add_preloads(contacts, bodies))
      structures.push_back(std::move(body));
  }

  void
  Scene::create_objects(const std::vector<bodies::Refinements> &refinements)
  {
    Handler            &prm    = entries.prm;
    const unsigned int  dim    = bodies.dim;
    const auto          folder = entries.folder();
    std::vector<double> densities; // of each body
    // what will be refined is a mesh that has been, by no element so far
    const bodies::Refinements as_generated(adaptive.cycles > 0 ? 1 : 0);
    create_each(prm, "Body", bodies.names, [&](const std::string &name) {
      const std::size_t b = structures.size();
      structures.push_back(bodies::create_body(prm,
                                               dim,
                                               folder,
                                               name,
                                               refinements.empty() ?
                                                 as_generated :
                                                 refinements[b]));
      if (adaptive.cycles == 0)
        structures.back()->forget_mesh();
      prm.enter_subsection("Material");
      densities.push_back(prm.get_double("Density"));
      prm.leave_subsection();
      bodies.structures.push_back(structures.back().get());
    });
    // obstacles stay where they are, for contacts point to them
    const std::vector<std::string> &names = entries.names.obstacles;
    obstacles.reserve(names.size() + load_names.size());
    create_each(prm, "Obstacle", names, [&](const std::string &name) {
      obstacles.push_back(pairing::create_obstacle(prm, name, dim, folder));
    });
    create_each(prm, "Support", support_names, [&](const std::string &name) {
      bodies.supports.push_back(bodies::create_support(
        prm, name, dim, bodies.names, bodies.structures));
    });
    release_inactive(stages.active(times.back()), bodies.supports);
    create_each(prm, "Load", load_names, [&](const std::string &name) {
      loads.push_back(
        bodies::create_load(prm, name, dim, bodies.names, bodies.structures));
    });
    take_densities(densities, bodies.names, loads);
    add_weights(densities);
    create_each(prm,
                "Contact",
                entries.names.contacts,
                [&](const std::string &name) {
                  add_contact(prm, name, "Contact '" + name + "', ");
                });
    if (entries.finds_contacts)
      add_automatic_contacts();
    for (bodies::Load &load : loads)
      load.warms_contacts =
        std::any_of(contacts.begin(), contacts.end(), [&](const auto &contact) {
          return contact.body == load.body &&
                 pairing::has_law_of_temperature(contact);
        });
  }

  void
  Scene::find_contact_nodes()
  {
    const FormerKinematics  former = {shown_to_slide,
                                     restart ? &*restart : nullptr};
    ContactKinematicsChoice choice(*this, former, *this, kinematics);
    pairings = choice.pair(adjusted_contacts);
    n_shared = choice.n_shared();
    keep_nodes(contacts, bodies);
    contact::keep_common_turns_free(bodies);
    contact::give_up_held_nodes(bodies);
  }

  void
  Scene::add_weights(const std::vector<double> &densities)
  {
    const std::string given = entries.prm.get("Gravity");
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
  Scene::add_contact(Handler           &prm,
                     const std::string &name,
                     const std::string &in)
  {
    if (pairing::adjusts_gaps(prm))
      adjusted_contacts.push_back(static_cast<unsigned int>(contacts.size()));
    contacts.push_back(pairing::create_contact(
      prm, name, in, bodies.dim, bodies.names, bodies.structures, obstacles));
    if (path.follows)
      pairing::take_cohesion_of_path(prm, in, contacts.back());
    kinematics.push_back({pairing::read_kinematics(prm), {}, {}, {}});
    if (bodies.dim == 2 && contacts.back().friction->is_elliptic())
      throw InputError(in + "Second friction coefficient: there is one tangent "
                            "only in 2D. Leave it empty.");
  }

  void
  Scene::add_automatic_contacts()
  {
    if (!near_sides)
      near_sides = find_near_sides(entries.prm,
                                   bodies.names,
                                   bodies.structures,
                                   obstacles,
                                   named_sides(entries.prm, contact_names));
    for (const WrittenContact &contact : write_contacts(entries.prm,
                                                        *near_sides,
                                                        bodies.names,
                                                        bodies.structures,
                                                        obstacles))
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
} // namespace conetact::application
