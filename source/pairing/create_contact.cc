// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/base/nearest.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"
#include "conetact/bodies/face_nodes.h"
#include "conetact/bodies/groups.h"
#include "conetact/pairing/contact_entries.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/node_to_face.h"
#include "conetact/pairing/pair_spring.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  bool
  adjusts_gaps(const dealii::ParameterHandler &prm)
  {
    return prm.get("Gap") == "adjust";
  }

  namespace
  {
    const Obstacle &
    find_obstacle(const std::string           &name,
                  const std::vector<Obstacle> &obstacles,
                  const std::string           &in)
    {
      std::vector<std::string> names;
      for (const Obstacle &obstacle : obstacles)
        {
          names.push_back(obstacle.name);
          if (name == obstacle.name)
            return obstacle;
        }
      throw InputError(
        in + "Obstacle: " +
        (name.empty() ? "it is empty" : "there is no obstacle '" + name + "'") +
        ". Give " + (names.empty() ? "" : "one of " + join(names) + ", or ") +
        "a Master body." + did_you_mean(name, names));
    }

    /** Throws InputError where there is an obstacle, too. */
    unsigned int
    find_master_body(const dealii::ParameterHandler &prm,
                     const std::vector<std::string> &bodies,
                     const std::string              &in)
    {
      if (!prm.get("Obstacle").empty())
        throw InputError(in + "Obstacle: there is a Master body too. Leave one "
                              "of them empty.");
      return bodies::find_body(prm.get("Master body"),
                               bodies,
                               in + "Master body");
    }

    void
    find_master(dealii::ParameterHandler                     &prm,
                const std::string                            &in,
                const std::vector<std::string>               &bodies,
                const std::vector<const bodies::Structure *> &structures,
                Contact                                      &contact)
    {
      contact.master     = find_master_body(prm, bodies, in);
      contact.master_ids = bodies::find_boundary(prm.get("Master boundary ids"),
                                                 *structures[contact.master],
                                                 bodies[contact.master],
                                                 in + "Master boundary ids");
      const std::string reach = prm.get("Reach");
      contact.reach = reach.empty() ? size_of(*structures[contact.body],
                                              *structures[contact.master]) :
                                      to_number(reach, in + "Reach");
      if (contact.reach < 0)
        throw InputError(in + "Reach: '" + reach +
                         "' is negative. Give a "
                         "length, or leave the entry empty.");
      if (!prm.get("Gap").empty() && !adjusts_gaps(prm))
        contact.gap.emplace(prm.get("Gap"), in + "Gap");
      const bodies::Surface own =
        structures[contact.body]->surface(contact.ids);
      if (has_nodes_as_masters(contact, structures) &&
          (own.two_sided || own.faces.empty()))
        throw InputError(in +
                         "Master boundary ids: they are single nodes of '" +
                         bodies[contact.master] +
                         "', which only faces of a continuum meet, and '" +
                         bodies[contact.body] +
                         "' is a frame. Give boundary ids of its members.");
      if (own.two_sided &&
          !structures[contact.master]->surface(contact.master_ids).two_sided)
        throw InputError(in + "Body: '" + bodies[contact.body] +
                         "' is a frame and its master a continuum. Exchange "
                         "them: the continuum's nodes meet the frame.");
      if (contact.body == contact.master)
        for (const unsigned int id : contact.master_ids)
          // A face against itself would be 0 = 0.
          if (contact.ids.count(id) > 0)
            throw InputError(
              in + "Master boundary ids: the faces with the id " +
              bodies::name_of(id, structures[contact.body]->boundary_groups()) +
              " are on both sides of the contact. Give each "
              "side its own boundary ids.");
    }

    /** Refuses entries of a master body where there is an obstacle. */
    void
    refuse_masters(const dealii::ParameterHandler &prm, const std::string &in)
    {
      if (!prm.get("Gap").empty() && !adjusts_gaps(prm))
        throw InputError(in + "Gap: it is that to a Master body. Gaps to an "
                              "obstacle follow from its place: leave it "
                              "empty, or give adjust.");
      bodies::refuse_given(prm,
                           {"Master boundary ids", "Reach"},
                           in,
                           "it is one of a Master body, and all nodes meet "
                           "the Obstacle, however far. Remove it, or name a "
                           "Master body in place of the Obstacle.");
    }

    void
    find_kind(const dealii::ParameterHandler &prm, Contact &contact)
    {
      const KindRow &row     = *std::find_if(contact_kinds().begin(),
                                         contact_kinds().end(),
                                         [&](const KindRow &r) {
                                           return r.name == prm.get("Kind");
                                         });
      contact.kind           = row.kind;
      const std::string name = prm.get("Pairing");
      const bool        chosen =
        std::any_of(pairings().begin(),
                    pairings().end(),
                    [&](const PairingRow &r) { return r.name == name; });
      contact.pairing = chosen ? name : row.pairing;
    }

    /** Refuses what belongs to a cone in contacts that are bound, for they have
     * none. */
    void
    refuse_cone(const dealii::ParameterHandler &prm,
                const Contact                  &contact,
                const std::string              &in)
    {
      const auto refuse = [&](const char *entry) {
        throw InputError(
          in + entry + ": a contact with Kind = " + prm.get("Kind") + " has " +
          (contact.kind == ContactKind::spring ?
             "no friction, for it acts along one line" :
           contact.kind == ContactKind::tie ?
             "no friction cone, it carries any reaction" :
             "no friction, for a reaction that may pull has no cone") +
          ". Leave the entry at its default, or choose Kind = contact.");
      };
      if (!contact.friction->expression().is_zero())
        refuse("Friction coefficient");
      for (const char *entry : {"Shear limit",
                                "Compliance",
                                "Unloading compliance",
                                "Shear compliance",
                                "Wear coefficient"})
        if (!prm.get(entry).empty())
          refuse(entry);
      for (const char *entry :
           {"Cohesion", "Tensile strength", "Second friction coefficient"})
        if (!prm.get(entry).empty() &&
            !Expression(prm.get(entry), in + entry, names_of_situation())
               .is_zero())
          refuse(entry);
      if (contact.active && contact.kind == ContactKind::bilateral)
        throw InputError(in +
                         "Active: a contact with Kind = " + prm.get("Kind") +
                         " is an equation that always holds. Leave the entry "
                         "at its default, or choose Kind = contact.");
      if (contact.may_part() && !prm.get("Gap").empty())
        throw InputError(in + "Gap: a tie that begins or ends holds its sides "
                              "as it finds them. Leave the entry empty, or "
                              "Active at its default.");
      if (contact.prestress && !contact.prestress->is_zero())
        refuse("Prestress");
    }

    /** Reads the limits of what may be paired at all. */
    void
    find_limits(dealii::ParameterHandler &prm,
                const std::string        &in,
                Contact                  &contact)
    {
      const double angle =
        to_number(prm.get("Largest angle"), in + "Largest angle");
      if (angle < 0 || angle > 90)
        throw InputError(in + "Largest angle: " + prm.get("Largest angle") +
                         " is not an angle between opposing faces. Give 0 to "
                         "90 degrees.");
      contact.largest_angle = angle * M_PI / 180;
      const double edge =
        to_number(prm.get("Sharp edge angle"), in + "Sharp edge angle");
      if (edge < 0 || edge > 90)
        throw InputError(in +
                         "Sharp edge angle: " + prm.get("Sharp edge angle") +
                         " is no angle of an edge. Give 0 to 90 degrees.");
      contact.sharp_edge     = edge * M_PI / 180;
      const std::string deep = prm.get("Largest interference");
      if (deep.empty())
        return;
      contact.interference = to_number(deep, in + "Largest interference");
      if (*contact.interference < 0)
        throw InputError(in + "Largest interference: " + deep +
                         " is negative. Give a length of 0 or more.");
    }
  } // namespace

  namespace
  {
    std::optional<Preload>
    read_preload(const dealii::ParameterHandler &prm,
                 const unsigned int              dim,
                 const Contact                  &contact,
                 const std::string              &in)
    {
      if (contact.spring) // whose Preload is its force at the start
        return {};
      if (prm.get("Preload").empty())
        {
          bodies::refuse_given(prm,
                               {"Preload axis", "Preload locked from"},
                               in,
                               "there is no Preload. Give its force, or "
                               "remove the entry.");
          return {};
        }
      if (contact.kind != ContactKind::tie)
        throw InputError(in + "Preload: a force tightens two sides that are "
                              "joined. Set Kind = tie and cut the bolt in two "
                              "there, or use Prestress.");
      if (contact.gap)
        throw InputError(in + "Gap: a tie with a Preload finds by itself how "
                              "far its sides move. Remove one of both.");
      if (contact.may_part())
        throw InputError(in + "Preload: a tie that it tightens lasts. Leave "
                              "Active at its default, or the entry empty.");
      Preload preload{Expression(prm.get("Preload"), in + "Preload"), {}, {}};
      if (preload.force.uses_space())
        throw InputError(in + "Preload: '" + prm.get("Preload") +
                         "' depends on position. It is one force on the whole "
                         "cut: use t only.");
      if (!prm.get("Preload axis").empty())
        {
          preload.axis =
            to_vector(prm.get("Preload axis"), dim, in + "Preload axis");
          if (preload.axis.norm() == 0)
            throw InputError(in + "Preload axis: it has no length. Give a "
                                  "direction other than zero.");
          preload.axis /= preload.axis.norm();
        }
      if (!prm.get("Preload locked from").empty())
        preload.locked_from =
          to_number(prm.get("Preload locked from"), in + "Preload locked from");
      return preload;
    }

    /** Refuses single nodes against faces of second degree: their forces,
     * weighed by functions of second degree, are no uniform pressure there. */
    void
    refuse_single_nodes(
      const Contact                                &contact,
      const std::string                            &in,
      const std::vector<const bodies::Structure *> &structures)
    {
      if (contact.obstacle != nullptr || contact.pairing != "node to face")
        return;
      const auto is_of_second_degree = [&](const unsigned int         body,
                                           const bodies::BoundaryIds &ids) {
        const auto faces = structures[body]->surface(ids).faces;
        return !faces.empty() &&
               bodies::is_of_second_degree(*structures[body], faces.front());
      };
      if (is_of_second_degree(contact.master, contact.master_ids) &&
          !is_of_second_degree(contact.body, contact.ids))
        throw InputError(in + "Pairing: node to face does not pass a uniform "
                              "pressure from nodes of first degree to faces of "
                              "second degree (Element = Q2 or P2). Exchange "
                              "Body and Master body, or choose mortar.");
    }
  } // namespace

  namespace
  {
    Expression
    constant(const dealii::ParameterHandler &prm,
             const std::string              &entry,
             const std::string              &in)
    {
      Expression expression(prm.get(entry), in + entry);
      if (expression.uses_time())
        throw InputError(in + entry +
                         ": it depends on t. It stays the same: "
                         "use x, y, z only.");
      return expression;
    }
  } // namespace

  void
  take_cohesion_of_path(dealii::ParameterHandler &prm,
                        const std::string        &in,
                        Contact                  &contact)
  {
    if (contact.bond && !contact.bond->is_plain_cohesion())
      throw InputError(in + "Tensile strength: Solver/Method = load path knows "
                            "cohesion only, which is never lost. Leave Tensile "
                            "strength at 0 and Cohesion lost at never, or "
                            "choose another method.");
    contact.path_cohesion.emplace(constant(prm, "Cohesion", in));
    contact.bond.reset();
  }

  Contact
  read_contact_law(dealii::ParameterHandler &prm, const std::string &in)
  {
    Contact contact;
    find_kind(prm, contact);
    if (adjusts_gaps(prm) && contact.kind != ContactKind::contact)
      throw InputError(in + "Gap: adjust is for Kind = contact. Ties and "
                            "bilateral contacts keep gaps as they are drawn: "
                            "leave the entry empty, or give 0 to close them.");
    find_limits(prm, in, contact);
    contact.friction =
      std::make_shared<FrictionLaw>(prm.get("Friction coefficient"),
                                    contact.kind == ContactKind::contact ?
                                      prm.get("Second friction coefficient") :
                                      "",
                                    prm.get("Shear limit"),
                                    in);
    if (auto layer = std::make_shared<LayerLaw>(prm, in); !layer->is_none())
      contact.layer = layer;
    if (auto bond = std::make_shared<BondLaw>(prm, in); !bond->is_none())
      contact.bond = bond;
    contact.friction_angle =
      to_number(prm.get("Friction angle"), in + "Friction angle") * M_PI / 180;
    if (auto active =
          bodies::read_active(prm, in, ", and Boundary ids for what is where"))
      contact.active = std::make_shared<Expression>(*std::move(active));
    if (contact.bond && !prm.get("Unloading compliance").empty())
      throw InputError(in + "Unloading compliance: what is glued springs back "
                            "as it closed. Leave the entry empty, or Cohesion "
                            "and Tensile strength at 0.");
    contact.prestress.emplace(constant(prm, "Prestress", in));
    if (contact.kind != ContactKind::contact)
      refuse_cone(prm, contact, in);
    refuse_idle_entries(prm, in);
    return contact;
  }

  namespace
  {
    void
    add_fluid(const dealii::ParameterHandler               &prm,
              const unsigned int                            dim,
              const std::vector<const bodies::Structure *> &structures,
              const std::vector<std::string>               &names,
              const std::string                            &in,
              Contact                                      &contact)
    {
      const std::string entry = in + "Penetrating pressure";
      if (contact.kind != ContactKind::contact)
        throw InputError(entry + ": a contact with Kind = " + prm.get("Kind") +
                         " never opens. Leave the entry empty, or choose Kind "
                         "= contact.");
      if (contact.bond)
        throw InputError(entry +
                         ": what is bonded keeps a fluid out. Leave the "
                         "entry empty, or Cohesion and Tensile strength "
                         "at 0.");
      if (contact.layer && contact.layer->wears())
        throw InputError(entry + ": what wears is not wet. Leave the entry or "
                                 "Wear coefficient empty.");
      contact.fluid = std::make_shared<FluidLaw>(prm,
                                                 dim,
                                                 *structures[contact.body],
                                                 names[contact.body],
                                                 contact.ids,
                                                 in);
      contact.fluid->pressure(0);
    }
  } // namespace

  namespace
  {
    /**
     * Finds the ends of a spring; the ground is an obstacle that nobody names.
     */
    void
    find_ends(const dealii::ParameterHandler &prm,
              const unsigned int              dim,
              const std::vector<std::string> &bodies,
              const std::vector<Obstacle>    &obstacles,
              const std::string              &in,
              Contact                        &contact)
    {
      bodies::refuse_given(prm,
                           {"Boundary ids", "Master boundary ids", "Reach"},
                           in,
                           "a spring ends at points. Leave the entry empty, "
                           "and give Point and Master point.");
      contact.spring = std::make_shared<SpringLaw>(prm, dim, in);
      if (prm.get("Master body").empty())
        contact.obstacle = prm.get("Obstacle").empty() ?
                             &ground() :
                             &find_obstacle(prm.get("Obstacle"), obstacles, in);
      else
        contact.master = find_master_body(prm, bodies, in);
    }
  } // namespace

  Contact
  create_contact(dealii::ParameterHandler                     &prm,
                 const std::string                            &name,
                 const std::string                            &in,
                 const unsigned int                            dim,
                 const std::vector<std::string>               &bodies,
                 const std::vector<const bodies::Structure *> &structures,
                 const std::vector<Obstacle>                  &obstacles)
  {
    Contact contact = read_contact_law(prm, in);
    contact.name    = name;
    contact.body    = bodies::find_body(prm.get("Body"), bodies, in + "Body");
    if (contact.kind == ContactKind::spring)
      {
        find_ends(prm, dim, bodies, obstacles, in, contact);
        return contact;
      }
    refuse_spring_entries(prm, in);
    contact.ids = bodies::find_boundary(prm.get("Boundary ids"),
                                        *structures[contact.body],
                                        bodies[contact.body],
                                        in + "Boundary ids");
    if (has_fluid(prm, in))
      add_fluid(prm, dim, structures, bodies, in, contact);
    if (prm.get("Master body").empty())
      {
        contact.obstacle = &find_obstacle(prm.get("Obstacle"), obstacles, in);
        refuse_masters(prm, in);
      }
    else
      find_master(prm, in, bodies, structures, contact);
    refuse_single_nodes(contact, in, structures);
    contact.preload = read_preload(prm, dim, contact, in);
    if (contact.obstacle != nullptr && prm.get("Pairing") == "mortar")
      throw InputError(in + "Pairing: mortar is for faces of a Master body. "
                            "Obstacles are met node by node: leave the entry "
                            "out.");
    return contact;
  }
} // namespace conetact::pairing
