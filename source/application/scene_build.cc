// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a scene is made of, from its entries.

#include "conetact/application/axisymmetry.h"
#include "conetact/application/scene.h"
#include "conetact/application/scene_entries.h"
#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/body_table.h"
#include "conetact/contact/free_obstacles.h"
#include "conetact/contact/held_nodes.h"
#include "conetact/contact/preloads.h"
#include "conetact/pairing/adjusted_gaps.h"
#include "conetact/pairing/obstacle_table.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

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
  } // namespace

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
} // namespace conetact::application
