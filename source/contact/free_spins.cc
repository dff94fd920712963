// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/free_spins.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace conetact::contact
{
  namespace
  {
    using pairing::Contact;
    using pairing::RoundSurface;

    bool
    is_on(const unsigned int body, const Contact &contact)
    {
      return contact.body == body ||
             (contact.obstacle == nullptr && contact.master == body);
    }

    /** Whether it presses, and does nothing else. */
    bool
    is_smooth(const Contact &contact)
    {
      return contact.kind == pairing::ContactKind::contact &&
             contact.friction && contact.friction->is_constant() &&
             contact.friction->expression(0).is_zero() &&
             contact.friction->expression(1).is_zero() && !contact.bond &&
             !contact.layer && !contact.spring && !contact.fluid &&
             !contact.active &&
             (!contact.prestress || contact.prestress->is_zero()) &&
             (!contact.path_cohesion || contact.path_cohesion->is_zero()) &&
             (contact.obstacle != nullptr || contact.body != contact.master);
    }

    /** The surface that all pairs of a body have in common; none. */
    std::optional<RoundSurface>
    round_side(const unsigned int          body,
               const std::vector<Contact> &contacts,
               const model::Bodies        &bodies)
    {
      std::optional<RoundSurface> common;
      for (const Contact &contact : contacts)
        if (is_on(body, contact))
          {
            if (!is_smooth(contact))
              return {};
            if (contact.obstacle != nullptr)
              continue;
            const auto round =
              pairing::round_surface(*bodies.structures[body],
                                     contact.body == body ? contact.ids :
                                                            contact.master_ids,
                                     bodies.dim);
            if (!round || (common && !round->is_about_axis_of(*common)))
              return {};
            common = round;
          }
      return common;
    }

    /** Whether nodal forces have no moment about the axis, but rounding. */
    bool
    is_without_moment(const Eigen::VectorXd   &f,
                      const bodies::Structure &body,
                      const RoundSurface      &round)
    {
      constexpr double   rounding = 1e-10;
      const unsigned int n_c      = body.n_components();
      Tensor<1, 3>       sum;
      double             all = 0;
      for (unsigned int i = 0; i < body.n_nodes(); ++i)
        {
          Tensor<1, 3> force;
          for (unsigned int c = 0; c < std::min(n_c, 3u); ++c)
            force[c] = f[static_cast<Eigen::Index>(i) * n_c + c];
          const Tensor<1, 3> arm = body.position(i) - round.centre;
          sum += cross_product_3d(arm, force);
          all += arm.norm() * force.norm();
        }
      const double about =
        round.axis.norm() > 0 ? std::abs(sum * round.axis) : sum.norm();
      return about <= rounding * all;
    }

    bool
    loads_turn(const unsigned int               b,
               const RoundSurface              &round,
               const std::vector<bodies::Load> &loads,
               const std::vector<double>       &times,
               const model::Bodies             &bodies)
    {
      const bodies::Structure &body = *bodies.structures[b];
      for (const double t :
           {times.front(), times[times.size() / 2], times.back()})
        {
          Eigen::VectorXd f = Eigen::VectorXd::Zero(body.n_dofs());
          for (const bodies::Load &load : loads)
            if (load.body == b && !load.strains())
              load.add(body, t, f);
          if (!is_without_moment(f, body, round))
            return true;
        }
      return false;
    }

    bool
    is_held(const unsigned int body, const model::Bodies &bodies)
    {
      return bodies.structures[body]->n_components() != bodies.dim ||
             std::any_of(bodies.supports.begin(),
                         bodies.supports.end(),
                         [&](const bodies::Support &support) {
                           return support.body == body;
                         });
    }

    /** Normals of a surface at nodes around which it is a plane. */
    std::map<unsigned int, Tensor<1, 3>>
    planes_of(const bodies::Surface &surface)
    {
      constexpr double                     rounding = 1e-6; // rad
      std::map<unsigned int, Tensor<1, 3>> planes;
      for (const bodies::SurfaceFace &face : surface.faces)
        for (const unsigned int i : face.nodes)
          {
            const auto [plane, is_new] = planes.emplace(i, face.normal);
            if ((plane->second - face.normal).norm() > rounding)
              plane->second = Tensor<1, 3>();
          }
      for (auto plane = planes.begin(); plane != planes.end();)
        plane = plane->second.norm() == 0 ? planes.erase(plane) : ++plane;
      return planes;
    }

    std::map<unsigned int, Tensor<1, 3>>
    planes_opposite(const unsigned int   body,
                    const Contact       &contact,
                    const model::Bodies &bodies)
    {
      const bool is_master = body != contact.body;
      return planes_of(
        is_master ?
          bodies.structures[contact.body]->surface(contact.ids) :
          bodies.structures[contact.master]->surface(contact.master_ids));
    }

    /** The normal of a plane that a node lies on, or faces, opposite to a round
     * side, in space; none: it is not that of a plane. */
    std::optional<Tensor<1, 3>>
    plane_at(const pairing::ContactNode &node,
             const model::RoundSide     &side,
             const model::Bodies        &bodies)
    {
      std::optional<Tensor<1, 3>> normal;
      bool                        is_plane = true;
      const auto                  look_at  = [&](const unsigned int i, double) {
        const auto plane = side.opposite_planes.find(i);
        is_plane = is_plane && plane != side.opposite_planes.end();
        if (is_plane)
          normal = plane->second;
      };
      const bool is_master = node.body != side.body;
      if (is_master)
        pairing::for_each_slave(node, look_at);
      else
        for (const auto &[i, weight] : node.masters)
          look_at(i, weight);
      if (!is_plane || !normal)
        return {};
      return bodies.in_space(is_master ? node.body : node.master, *normal);
    }

    /** Where the force of a contact node acts on its side, undeformed. */
    Point<3>
    acting_on(const pairing::ContactNode &node,
              const bool                  is_master,
              const bodies::Structure    &body)
    {
      Point<3>   mean;
      const auto add = [&](const unsigned int i, const double weight) {
        mean += weight * Tensor<1, 3>(body.position(i));
      };
      if (is_master)
        for (const auto &[i, weight] : node.masters)
          add(i, weight);
      else
        pairing::for_each_slave(node, add);
      return mean;
    }
  } // namespace

  std::vector<model::RoundSide>
  find_free_spins(const std::vector<Contact>      &contacts,
                  const std::vector<bodies::Load> &loads,
                  const std::vector<double>       &times,
                  const model::Bodies             &bodies)
  {
    std::vector<model::RoundSide> found;
    if (bodies.are_axisymmetric() || times.empty())
      return found;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        if (is_held(body, bodies))
          continue;
        const auto round = round_side(body, contacts, bodies);
        if (!round || loads_turn(body, *round, loads, times, bodies))
          continue;
        for (unsigned int c = 0; c < contacts.size(); ++c)
          if (contacts[c].obstacle == nullptr && is_on(body, contacts[c]))
            found.push_back(
              {c, body, *round, planes_opposite(body, contacts[c], bodies)});
      }
    return found;
  }

  /* Of two such sides of a contact the last one counts. What rolls on a plane
     is pressed along the normal of the plane, wherever the node is; it may turn
     until facets lie on the planes. */
  void
  point_to_axes(const model::Bodies               &bodies,
                std::vector<pairing::ContactNode> &nodes)
  {
    constexpr double askew = .9; // cosine: edges and corners keep theirs
    for (const model::RoundSide &side : bodies.round_sides)
      for (pairing::ContactNode &node : nodes)
        {
          if (node.contact != side.contact || node.meets_nothing())
            continue;
          const bool   is_master = node.body != side.body;
          const auto   plane     = plane_at(node, side, bodies);
          Tensor<1, 3> n =
            plane ?
              *plane :
              bodies.in_space(
                side.body,
                side.surface.outward(
                  acting_on(node, is_master, *bodies.structures[side.body])));
          if (n * node.n < 0)
            n *= -1;
          if (n * node.n > askew)
            pairing::set_frame(node, n, bodies.dim);
        }
  }
} // namespace conetact::contact
