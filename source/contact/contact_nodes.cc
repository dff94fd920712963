// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_nodes.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/structures/actions.h"

#include <cmath>
#include <map>

namespace conetact
{
  namespace
  {
    double
    friction_at(const Expression  &friction,
                const Point<3>    &p,
                const std::string &entry)
    {
      const double mu = friction(p);
      if (mu < 0)
        throw InputError(entry + ": it is " + to_text(mu) + " at " +
                         to_text(p) + ". Give a value of 0 or more.");
      return mu;
    }

    void
    set_friction(ContactNode &node, const Contact &contact)
    {
      const std::string in = "Contact '" + contact.name + "', ";
      const double      c  = std::cos(contact.friction_angle);
      const double      s  = std::sin(contact.friction_angle);
      node.axis_1          = c * node.t1 + s * node.t2;
      node.axis_2          = c * node.t2 - s * node.t1;
      node.mu_1            = friction_at(*contact.friction,
                              node.position,
                              in + "Friction coefficient");
      node.mu_2            = contact.second_friction ?
                               friction_at(*contact.second_friction,
                                node.position,
                                in + "Second friction coefficient") :
                               node.mu_1;
    }

    double
    spacing(const double area, const unsigned int dim)
    {
      return dim == 2 ? area : std::sqrt(area);
    }
  } // namespace

  std::pair<Tensor<1, 3>, Tensor<1, 3>>
  tangents(const Tensor<1, 3> &n, const unsigned int dim)
  {
    Tensor<1, 3> e_y, e_z;
    e_y[1] = e_z[2] = 1;
    if (dim == 2)
      return {Tensor<1, 3>({n[1], -n[0], 0.}), e_z};
    Tensor<1, 3> t1 =
      std::abs(n[2]) > .9 ? cross_product_3d(e_y, n) : cross_product_3d(n, e_z);
    t1 /= t1.norm();
    return {t1, cross_product_3d(n, t1)};
  }

  void
  declare_contact(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Body", "", Anything(), "Name of the body.");
    prm.declare_entry("Boundary ids",
                      "",
                      Anything(),
                      "Boundary ids of the body whose nodes may touch, "
                      "separated by commas.");
    prm.declare_entry("Obstacle",
                      "",
                      Anything(),
                      "Name of the rigid obstacle they may touch.");
    prm.declare_entry("Friction coefficient",
                      "0",
                      Anything(),
                      "Coulomb's mu, 0 or more, a function of x, y, z; mu in "
                      "[K] (5). [-]");
    prm.declare_entry("Second friction coefficient",
                      "",
                      Anything(),
                      "Friction coefficient across the first axis, for an "
                      "elliptic cone ([K] remark 3.3; 3D). Empty: isotropic. "
                      "[-]");
    prm.declare_entry("Friction angle",
                      "0",
                      Anything(),
                      "Angle of the first axis from the tangent t1 towards "
                      "t2, for an elliptic cone. [degrees]");
  }

  Contact
  create_contact(dealii::ParameterHandler             &prm,
                 const std::string                    &name,
                 const std::vector<std::string>       &bodies,
                 const std::vector<const Structure *> &structures,
                 const std::vector<Obstacle>          &obstacles)
  {
    const std::string in = "Contact '" + name + "', ";
    Contact           contact;
    contact.name = name;
    contact.body = find_body(prm.get("Body"), bodies, in + "Body");
    contact.ids  = find_boundary(prm.get("Boundary ids"),
                                *structures[contact.body],
                                bodies[contact.body],
                                in + "Boundary ids");
    std::vector<std::string> names;
    for (const Obstacle &obstacle : obstacles)
      {
        names.push_back(obstacle.name);
        if (prm.get("Obstacle") == obstacle.name)
          contact.obstacle = &obstacle;
      }
    if (contact.obstacle == nullptr)
      throw InputError(in + "Obstacle: there is no obstacle '" +
                       prm.get("Obstacle") + "'. Give one of: " + join(names) +
                       ".");

    contact.friction.emplace(prm.get("Friction coefficient"),
                             in + "Friction coefficient");
    if (!prm.get("Second friction coefficient").empty())
      contact.second_friction.emplace(prm.get("Second friction coefficient"),
                                      in + "Second friction coefficient");
    contact.friction_angle =
      to_number(prm.get("Friction angle"), in + "Friction angle") * M_PI / 180;
    for (const auto *friction : {&contact.friction, &contact.second_friction})
      if (*friction && (*friction)->uses_time())
        throw InputError(in + "Friction coefficient: it depends on t. "
                              "Friction stays the same: use x, y, z only.");
    return contact;
  }

  std::vector<ContactNode>
  find_contact_nodes(const std::vector<Contact>           &contacts,
                     const std::vector<std::string>       &bodies,
                     const std::vector<const Structure *> &structures,
                     const unsigned int                    dim)
  {
    std::vector<ContactNode>                                      nodes;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> contact_of;
    for (unsigned int c = 0; c < contacts.size(); ++c)
      {
        const Contact &contact = contacts[c];
        const Surface  surface = structures[contact.body]->surface(contact.ids);
        for (const SurfaceNode &s : surface.nodes)
          {
            const auto [other, is_new] =
              contact_of.insert({{contact.body, s.node}, c});
            if (!is_new)
              throw InputError(
                "Contact '" + contacts[other->second].name + "' and contact '" +
                contact.name + "' both hold the node at " +
                to_text(s.position) + " of body '" + bodies[contact.body] +
                "'. A node stands in one contact only: change Boundary ids.");
            ContactNode node;
            node.contact  = c;
            node.body     = contact.body;
            node.node     = s.node;
            node.position = s.position;
            node.area     = s.area;
            node.obstacle = contact.obstacle;
            const auto closest =
              contact.obstacle->shape->closest(s.position,
                                               spacing(s.area, dim));
            node.gap                   = closest.gap;
            node.n                     = closest.normal;
            std::tie(node.t1, node.t2) = tangents(node.n, dim);
            set_friction(node, contact);
            nodes.push_back(node);
          }
      }
    return nodes;
  }
} // namespace conetact
