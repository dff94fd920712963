// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/faces_on_obstacle.h"

#include "conetact/pairing/dual_functions.h"
#include "conetact/pairing/mortar_rows.h"
#include "conetact/pairing/nodal_shapes.h"
#include "conetact/pairing/projected_face.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace conetact::pairing
{
  namespace
  {
    using Eigen::Index;

    /** Of each node the row of its side that looks at the obstacle. */
    std::map<unsigned int, const MortarRow *>
    facing_sides(const Contact           &contact,
                 const bodies::Structure &body,
                 const MortarRows        &sides)
    {
      std::map<unsigned int, const MortarRow *> result;
      std::map<unsigned int, double>            least;
      for (const MortarRow &side : sides.all())
        {
          const Tensor<1, 3> n =
            contact.obstacle->shape
              ->closest(body.position(side.node), std::sqrt(side.whole))
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

    /** A point of a face: all shape functions, and the linear ones. */
    struct FacePoint
    {
      Eigen::VectorXd shapes, linear;
      double          area;
    };

    std::vector<FacePoint>
    points_of(const FaceNet::Face &face)
    {
      const ProjectionPlane  plane(face.centre,
                                  face.outward,
                                  face.corners.size() == 2);
      const ProjectedFace    own(face, plane);
      std::vector<FacePoint> points;
      for (const PlanePoint &q :
           gauss_points(own.outline(), own.skewness() == 0 ? 0 : 1))
        {
          const ProjectedFace::Seen seen = own.at(q.position);
          points.push_back(
            {nodal_shapes(face, seen),
             seen.shape.head(static_cast<Index>(face.n_functions)),
             q.weight * seen.stretch});
        }
      return points;
    }

    /** The factors of the linear functions in the dual ones. */
    Eigen::MatrixXd
    dual_factors(const std::vector<FacePoint> &points, const Index n)
    {
      Eigen::MatrixXd mass  = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd areas = Eigen::VectorXd::Zero(n);
      for (const FacePoint &p : points)
        {
          mass += p.area * p.linear * p.linear.transpose();
          areas += p.area * p.linear;
        }
      std::vector<Index> all(static_cast<std::size_t>(n));
      std::iota(all.begin(), all.end(), Index{0});
      return dual_functions(mass, areas, all);
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
    , thickness(thickness_of(surface, net.all(), body.is_axisymmetric()))
  {
    Assert(contact.obstacle != nullptr,
           dealii::ExcMessage("Bodies are met by mortar rows."));
    MortarRows sides(net.all(), contact.sharp_edge, body.is_axisymmetric());
    const auto facing = facing_sides(contact, body, sides);
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

  void
  FacesOnObstacle::weigh(const unsigned int node, Row &row) const
  {
    constexpr double least     = .5; // cosine, beside edges of an obstacle
    const auto       normal_at = [&](const unsigned int i) {
      return contact.obstacle->shape
        ->closest(body.position(i), std::sqrt(row.area))
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

  void
  FacesOnObstacle::add(const std::size_t f, const std::vector<bool> &of_row)
  {
    const FaceNet::Face &face   = net.all()[f];
    const auto           points = points_of(face);
    const auto           n      = static_cast<Index>(face.n_functions);
    const auto           dual   = dual_factors(points, n);
    for (Index j = 0; j < n; ++j)
      if (of_row[static_cast<std::size_t>(j)])
        {
          Row &row = rows[face.nodes[static_cast<std::size_t>(j)]];
          for (const FacePoint &p : points)
            {
              const double weight = p.area * dual.row(j).dot(p.linear);
              row.area += weight;
              for (std::size_t k = 0; k < face.nodes.size(); ++k)
                row.slaves[face.nodes[k]] +=
                  weight * p.shapes[static_cast<Index>(k)];
            }
        }
  }

  FacesOnObstacle::Met
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
    Met        met{0, closest(node.node).normal, {}};
    for (const auto &[slave, weight] : row.weights)
      {
        const ObstacleShape::Closest there = closest(slave);
        met.gap += row.slaves.at(slave) / row.whole * there.gap;
        met.foot += weight / row.whole *
                    (Tensor<1, 3>(body.position(slave)) + moved_by(slave) -
                     there.gap * there.normal);
      }
    return met;
  }

  void
  FacesOnObstacle::place(ContactNode &node) const
  {
    const Met met  = meet(node, RigidMotion(), [](const unsigned int) {
      return Tensor<1, 3>();
    });
    node.gap       = met.gap;
    node.n         = met.normal;
    const Row &row = rows.at(node.node);
    node.area      = thickness * row.area * row.whole;
    node.slaves.clear();
    for (const auto &[slave, weight] : row.weights)
      node.slaves.emplace_back(slave, weight / row.whole);
  }
} // namespace conetact::pairing
