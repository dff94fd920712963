// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/preloads.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/rigid_body.h"
#include "conetact/contact/free_obstacles.h"

#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /** Means over the nodes of a contact, by their areas. */
    struct Face
    {
      Point<3>     centre;
      Tensor<1, 3> normal;
    };

    Face
    face_of(const unsigned int contact, const model::Bodies &bodies)
    {
      Face   face;
      double area = 0;
      for (const pairing::ContactNode &node : bodies.contact_nodes)
        if (node.contact == contact)
          {
            // Nodes without areas count alike if none has one, else not.
            const double part = node.area > 0 ? node.area : 1e-300;
            area += part;
            face.centre += part * Tensor<1, 3>(node.position);
            face.normal += part * node.n;
          }
      face.centre /= area;
      face.normal /= area;
      return face;
    }

    /**
     * The unit axis along which the sides of the cut move apart, from the
     * master to the body: where none is given the normal of its faces, whose
     * mean is shorter than 1 where they are not plane.
     */
    Tensor<1, 3>
    axis_of(const pairing::Contact &contact,
            const Face             &face,
            const bool              axisymmetric)
    {
      constexpr double  plane = .999, across = .1; // cosines
      const std::string in   = "Contact '" + contact.name + "', Preload axis: ";
      Tensor<1, 3>      axis = contact.preload->axis;
      if (axis.norm() == 0)
        {
          if (face.normal.norm() < plane)
            throw InputError(in + "the faces of the cut are not plane, and "
                                  "have no normal in common. Give the axis of "
                                  "the bolt.");
          axis = face.normal / face.normal.norm();
        }
      // An axis in the faces would let sides slide, not part.
      const double cosine = axis * face.normal;
      if (std::abs(cosine) < across)
        throw InputError(in + to_text(axis) +
                         " lies in the faces of the cut, whose normal is " +
                         to_text(face.normal) +
                         ". Give the axis of the bolt, which crosses them.");
      if (axisymmetric && std::abs(axis[1]) < 1 - 1e-9)
        throw InputError(in + "bodies of revolution are tightened along their "
                              "axis only. Give 0, 1.");
      return cosine < 0 ? -axis : axis;
    }

    /** A guide lets the rigid body of a cut move along its axis only: it holds
     * all other directions, and rotations. */
    bodies::Support
    guide_of(const model::Cut    &cut,
             const Point<3>      &centre,
             const model::Bodies &bodies)
    {
      bodies::Support support;
      support.name = bodies.names[cut.body];
      support.body = cut.body;
      support.surface.nodes.push_back({0, centre, 0, {}, {}});
      support.directions = complement({cut.axis}, bodies.dim);
      for (std::size_t k = 0; k < support.directions.size(); ++k)
        support.displacement.emplace_back("0", support.name);
      for (unsigned int c = bodies.dim == 2 ? 5 : 3; c < 6; ++c)
        support.rotations.push_back(
          {bodies.dim == 2 ? 2 : c, Expression("0", support.name)});
      return support;
    }
  } // namespace

  std::vector<std::unique_ptr<bodies::Structure>>
  add_preloads(const std::vector<pairing::Contact> &contacts,
               model::Bodies                       &bodies)
  {
    std::vector<std::unique_ptr<bodies::Structure>> made;
    for (unsigned int c = 0; c < contacts.size(); ++c)
      {
        if (!contacts[c].preload)
          continue;
        const Face face = face_of(c, bodies);
        model::Cut cut;
        cut.contact     = c;
        cut.body        = static_cast<unsigned int>(bodies.structures.size());
        cut.axis        = axis_of(contacts[c], face, bodies.are_axisymmetric());
        cut.locked_from = contacts[c].preload->locked_from;
        for (pairing::ContactNode &node : bodies.contact_nodes)
          if (node.contact == c)
            node.opening = cut.body;
        made.push_back(
          std::make_unique<bodies::RigidBody>(bodies.dim,
                                              face.centre,
                                              std::vector<Point<3>>(),
                                              bodies.are_axisymmetric()));
        bodies.names.push_back("preload " + contacts[c].name);
        bodies.structures.push_back(made.back().get());
        bodies.supports.push_back(guide_of(cut, face.centre, bodies));
        ++bodies.n_rigid;
        bodies.cuts.push_back(cut);
      }
    return made;
  }

  /* The body of a cut has the force -F e, and the reactions r_i of the tie the
     other way round: its balance is e . sum r_i = -F. */
  void
  add_preload_forces(const std::vector<pairing::Contact> &contacts,
                     const model::Bodies                 &bodies,
                     const double                         t,
                     Eigen::VectorXd                     &f)
  {
    const std::vector<Eigen::Index> first = first_dofs(bodies);
    for (const model::Cut &cut : bodies.cuts)
      if (!cut.is_locked_after(t))
        {
          const double tension =
            contacts[cut.contact].preload->force(Point<3>(), t);
          for (unsigned int c = 0; c < bodies.dim; ++c)
            f[first[cut.body] + c] -= tension * cut.axis[c];
        }
  }



  /* A prestress F presses both sides together with forces of its own, -F n on
     the body and F n on what it meets. [P] has it as the weight of tightening;
     together with the cohesion (1 - f) F it is the vector (1, 1, 1) F there. */
  Eigen::VectorXd
  prestress_forces(const model::Bodies &bodies)
  {
    std::vector<Eigen::Index> offset = {0};
    for (const bodies::Structure *structure : bodies.structures)
      offset.push_back(offset.back() + structure->n_dofs());
    Eigen::VectorXd forces; // empty: none
    const auto      add = [&](const unsigned int  body,
                         const unsigned int  node,
                         const Tensor<1, 3> &force) {
      if (forces.size() == 0)
        forces.setZero(offset.back());
      for (unsigned int c = 0; c < bodies.dim; ++c)
        forces[offset[body] +
               node * static_cast<Eigen::Index>(
                        bodies.structures[body]->n_components()) +
               c] += force[c];
    };
    for (const pairing::ContactNode &node : bodies.contact_nodes)
      if (node.prestress > 0)
        {
          pairing::for_each_side(node,
                                 [&](const unsigned int body,
                                     const unsigned int i,
                                     const double       weight) {
                                   add(body,
                                       i,
                                       -weight * node.prestress * node.n);
                                 });
        }
    return forces;
  }
} // namespace conetact::contact
