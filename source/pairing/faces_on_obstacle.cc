// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/faces_on_obstacle.h"

#include "conetact/pairing/corner_parts.h"
#include "conetact/pairing/mortar_rows.h"
#include "conetact/pairing/spacings.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace conetact::pairing
{
  namespace
  {
    /** Gives each node the row of the side of its edge that looks most against
     * the obstacle's normal. */
    std::map<unsigned int, const MortarRow *>
    facing_sides(const Contact                        &contact,
                 const bodies::Structure              &body,
                 const std::map<unsigned int, double> &spacing,
                 const MortarRows                     &sides)
    {
      std::map<unsigned int, const MortarRow *> result;
      std::map<unsigned int, double>            least;
      for (const MortarRow &side : sides.all())
        {
          const Tensor<1, 3> n =
            contact.obstacle->shape
              ->closest(body.position(side.node), spacing.at(side.node))
              .normal;
          const double cosine     = side.normal * n / side.normal.norm();
          const auto [at, is_new] = least.emplace(side.node, cosine);
          if (is_new || cosine < at->second)
            {
              at->second        = cosine;
              result[side.node] = &side;
            }
        }
      return result;
    }
  } // namespace

  bool
  FacesOnObstacle::suits(const bodies::Surface &surface)
  {
    return std::any_of(surface.faces.begin(),
                       surface.faces.end(),
                       [](const bodies::SurfaceFace &face) {
                         return face.meets_at_corners;
                       });
  }

  FacesOnObstacle::FacesOnObstacle(const Contact           &c,
                                   const bodies::Structure &b,
                                   const bodies::Surface   &surface)
    : contact(c)
    , body(b)
    , net(body, surface)
    , spacing(spacings(surface, body))
    , thickness(thickness_of(surface, net.all(), body.is_axisymmetric()))
  {
    Assert(contact.obstacle != nullptr,
           dealii::ExcMessage("Bodies are met by mortar rows."));
    MortarRows sides(net.all(), contact.sharp_edge, body.is_axisymmetric());
    const auto facing = facing_sides(contact, body, spacing, sides);
    for (std::size_t f = 0; f < net.all().size(); ++f)
      {
        const FaceNet::Face &face = net.all()[f];
        std::vector<bool>    of_row;
        for (std::size_t j = 0; j < face.n_functions; ++j)
          of_row.push_back(facing.at(face.nodes[j]) == &sides.at(f, j));
        add(f, of_row);
      }
    for (auto &[node, row] : rows)
      {
        for (auto &[slave, part] : row.slaves)
          part /= row.area;
        weigh(node, row);
      }
  }

  /**
   * Sets w_k = part_k / (n . n_k) with the normals n at the corner and n_k at
   * its slaves. A reaction r along n gives the slave k the force r w_k / W
   * along n, with the sum W of the w_k: its part along n_k is r part_k / W,
   * that of a uniform pressure.
   */
  void
  FacesOnObstacle::weigh(const unsigned int node, Row &row) const
  {
    constexpr double least     = .5; // cosine, beside edges of an obstacle
    const auto       normal_at = [&](const unsigned int i) {
      return contact.obstacle->shape
        ->closest(body.position(i), spacing.at(node))
        .normal;
    };
    const Tensor<1, 3> own = normal_at(node);
    row.whole              = 0;
    for (const auto &[slave, part] : row.slaves)
      if (std::abs(part) > 16 * std::numeric_limits<double>::epsilon())
        {
          const double weight = part / std::max(least, own * normal_at(slave));
          row.weights[slave]  = weight;
          row.whole += weight;
        }
  }

  /* Only corners on the side that faces the obstacle get a part of a face: the
     others belong to another side of an edge. */
  void
  FacesOnObstacle::add(const std::size_t f, const std::vector<bool> &of_row)
  {
    const FaceNet::Face &face  = net.all()[f];
    const CornerParts    parts = corner_parts(face);
    for (std::size_t j = 0; j < face.n_functions; ++j)
      if (of_row[j])
        parts.add(face, j, rows[face.nodes[j]]);
  }

  std::optional<FacesOnObstacle::Met>
  FacesOnObstacle::meet(const ContactNode  &node,
                        const RigidMotion  &motion,
                        const Displacement &at) const
  {
    const ObstacleShape &shape    = *contact.obstacle->shape;
    const auto           moved_by = [&](const unsigned int i) {
      return motion.relative(body.position(i), at(i));
    };
    const auto closest = [&](const unsigned int i) {
      return shape.closest_after(body.position(i), moved_by(i), node.spacing);
    };
    const Row &row = rows.at(node.node);
    const auto own = closest(node.node);
    if (!own)
      return {};
    Met met{0, own->normal, {}};
    for (const auto &[slave, weight] : row.weights)
      {
        const auto there = closest(slave);
        if (!there)
          return {};
        // Vectors g_k n_k from the obstacle to the slaves have the mean sum_k
        // w_k g_k n_k / W; its part along n is that of the gaps g_k part_k / W.
        met.gap += row.slaves.at(slave) / row.whole * there->gap;
        met.least = std::min(met.least, there->gap);
        met.foot += weight / row.whole *
                    (Tensor<1, 3>(body.position(slave)) + moved_by(slave) -
                     there->gap * there->normal);
      }
    return met;
  }

  void
  FacesOnObstacle::place(ContactNode &node) const
  {
    // Shapes that have no normal there have said so to the constructor.
    const Met met  = meet(node, RigidMotion(), [](const unsigned int) {
                      return Tensor<1, 3>();
                    }).value();
    node.gap       = met.gap;
    node.least_gap = met.least;
    node.n         = met.normal;
    const Row &row = rows.at(node.node);
    // A uniform pressure p has the reaction r = p A W, with the area A.
    node.area = thickness * row.area * row.whole;
    node.slaves.clear();
    for (const auto &[slave, weight] : row.weights)
      node.slaves.emplace_back(slave, weight / row.whole);
  }
} // namespace conetact::pairing
