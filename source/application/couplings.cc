// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/couplings.h"

#include "conetact/application/scene.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"
#include "conetact/bodies/groups.h"
#include "conetact/pairing/obstacle_table.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;
    using Nodes   = std::set<unsigned int>;

    bool
    are_coupled(const bodies::Load &one, const bodies::Load &other)
    {
      return one.body == other.body && one.ids == other.ids &&
             one.point == other.point;
    }

    /** Nodes of each face. */
    std::set<Nodes>
    faces_of(const bodies::Structure &body, const bodies::BoundaryIds &ids)
    {
      std::set<Nodes> faces;
      for (const bodies::SurfaceFace &face : body.surface(ids).faces)
        faces.emplace(face.nodes.begin(), face.nodes.end());
      return faces;
    }

    /** Throws InputError where what holds faces of a rigid load holds some of
     * its own. */
    class Claims
    {
    public:
      Claims(const bodies::Load                           &l,
             const std::vector<const bodies::Structure *> &s)
        : load(l)
        , structures(s)
        , faces(faces_of(*structures[load.body], load.ids))
      {}

      void
      refuse_faces(const unsigned int         body,
                   const bodies::BoundaryIds &ids,
                   const std::string         &whose) const
      {
        if (body != load.body)
          return;
        for (const Nodes &face : faces_of(*structures[body], ids))
          if (faces.count(face) > 0)
            throw InputError(
              "Load '" + load.name + "', Boundary ids: the face with the " +
              "node at " + to_text(structures[body]->position(*face.begin())) +
              " belongs to " + whose +
              " as well. Faces with Coupling = rigid move with their Point "
              "alone: leave it out of one of both.");
      }

      void
      refuse_nodes(const bodies::Load &other) const
      {
        if (other.body != load.body)
          return;
        Nodes own;
        for (const Nodes &face : faces)
          own.insert(face.begin(), face.end());
        for (const Nodes &face : faces_of(*structures[other.body], other.ids))
          for (const unsigned int node : face)
            if (own.count(node) > 0)
              throw InputError(
                "Load '" + load.name + "' and load '" + other.name +
                "', Coupling: the node at " +
                to_text(structures[load.body]->position(node)) +
                " would belong to two rigid ones. Give both loads the same "
                "Boundary ids and the same Point, or faces that share no "
                "node.");
      }

    private:
      const bodies::Load                           &load;
      const std::vector<const bodies::Structure *> &structures;
      const std::set<Nodes>                         faces;
    };

    void
    refuse_others(const Claims                        &claims,
                  const std::vector<bodies::Support>  &supports,
                  const std::vector<pairing::Contact> &contacts)
    {
      for (const bodies::Support &support : supports)
        if (!support.stiffness && !support.surface.nodes.empty())
          claims.refuse_faces(support.body,
                              support.ids,
                              "support '" + support.name + "'");
      for (const pairing::Contact &contact : contacts)
        {
          const std::string whose = "contact '" + contact.name + "'";
          claims.refuse_faces(contact.body, contact.ids, whose);
          if (contact.obstacle == nullptr)
            claims.refuse_faces(contact.master, contact.master_ids, whose);
        }
    }

    std::string
    components(const Point<3> &p, const unsigned int dim)
    {
      std::ostringstream text;
      text.precision(17);
      for (unsigned int d = 0; d < dim; ++d)
        text << (d > 0 ? ", " : "") << p[d];
      return text.str();
    }

    /** What its nodes meet is where they are. */
    std::unique_ptr<Handler>
    write_obstacle(const bodies::Load &load,
                   const unsigned int  dim,
                   const bool          is_axisymmetric)
    {
      auto entries = std::make_unique<Handler>();
      pairing::declare_obstacle(*entries);
      entries->set("Shape", "prescribed gap");
      // askew: no other obstacle of its nodes has the same normal
      entries->set("Normal", dim == 2 ? "0.6, 0.8" : "0.36, 0.48, 0.8");
      entries->set("Gap", "0");
      entries->set("Reference point", components(load.point, dim));
      entries->set("Free",
                   is_axisymmetric ? "y" :
                   dim == 2        ? "x, y, rz" :
                                     "x, y, z, rx, ry, rz");
      return entries;
    }

    std::unique_ptr<Handler>
    write_tie(const bodies::Load      &load,
              const std::string       &name,
              const std::string       &body,
              const bodies::Structure &structure)
    {
      auto entries = std::make_unique<Handler>();
      pairing::declare_contact(*entries);
      entries->set("Body", body);
      entries->set("Boundary ids",
                   bodies::join_names(load.ids, structure.boundary_groups()));
      entries->set("Obstacle", name);
      entries->set("Kind", "tie");
      return entries;
    }
  } // namespace

  std::vector<Coupling>
  find_couplings(const std::vector<bodies::Load>              &loads,
                 const std::vector<bodies::Support>           &supports,
                 const std::vector<pairing::Contact>          &contacts,
                 const std::vector<std::string>               &bodies,
                 const std::vector<const bodies::Structure *> &structures,
                 const unsigned int                            dim)
  {
    std::vector<Coupling> couplings;
    for (std::size_t i = 0; i < loads.size(); ++i)
      {
        const bodies::Load &load = loads[i];
        if (!load.is_rigid)
          continue;
        const auto same = std::find_if(
          couplings.begin(), couplings.end(), [&](const Coupling &coupling) {
            return are_coupled(loads[coupling.loads.front()], load);
          });
        if (same != couplings.end())
          {
            same->loads.push_back(i);
            continue;
          }
        const Claims claims(load, structures);
        for (const Coupling &other : couplings)
          claims.refuse_nodes(loads[other.loads.front()]);
        refuse_others(claims, supports, contacts);
        const std::string name = "coupling " + load.name;
        couplings.push_back(
          {name,
           {i},
           write_obstacle(load, dim, structures[load.body]->is_axisymmetric()),
           write_tie(load, name, bodies[load.body], *structures[load.body])});
      }
    return couplings;
  }



  std::vector<std::string>
  Scene::add_couplings()
  {
    std::vector<std::string> names(loads.size());
    for (const Coupling &coupling : find_couplings(loads,
                                                   bodies.supports,
                                                   contacts,
                                                   bodies.names,
                                                   bodies.structures,
                                                   bodies.dim))
      {
        const auto is_in = [&](const std::vector<std::string> &list) {
          return std::count(list.begin(), list.end(), coupling.name) > 0;
        };
        if (is_in(entries.names.obstacles) || is_in(contact_names))
          throw InputError("Load '" + load_names[coupling.loads.front()] +
                           "', Coupling: a contact or an obstacle has the "
                           "name of its rigid body, '" +
                           coupling.name + "'. Give it another one.");
        obstacles.push_back(pairing::create_obstacle(
          *coupling.obstacle, coupling.name, bodies.dim, entries.folder()));
        contact_names.push_back(coupling.name);
        add_contact(*coupling.contact,
                    coupling.name,
                    "Contact '" + coupling.name + "', ");
        contacts.back().couples = true;
        for (const std::size_t load : coupling.loads)
          names[load] = coupling.name;
      }
    return names;
  }



  void
  Scene::act_on_couplings(const std::vector<std::string> &names)
  {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!names[i].empty())
        loads[i].body = bodies::find_body(names[i], bodies.names, names[i]);
  }
} // namespace conetact::application
