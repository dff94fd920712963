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
        for (PointOfRow &point : row.points)
          point.weight /= row.area;
        for (auto &[slave, weight] : row.slaves)
          weight /= row.area;
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
              row.points.push_back({f, p.shapes, weight});
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
    const ObstacleShape &shape = *contact.obstacle->shape;
    Met                  met{0, {}, {}};
    for (const PointOfRow &point : rows.at(node.node).points)
      {
        const auto  &nodes = net.all()[point.face].nodes;
        Point<3>     X;
        Tensor<1, 3> u;
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            const double N = point.shapes[static_cast<Index>(k)];
            X += N * Tensor<1, 3>(body.position(nodes[k]));
            u += N * at(nodes[k]);
          }
        const ObstacleShape::Closest closest =
          shape.closest_after(X, motion.relative(X, u), node.spacing);
        met.gap += point.weight * closest.gap;
        met.foot += point.weight *
                    (X + motion.relative(X, u) - closest.gap * closest.normal);
      }
    met.normal = shape
                   .closest_after(node.position,
                                  motion.relative(node.position, at(node.node)),
                                  node.spacing)
                   .normal;
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
    node.area      = thickness * row.area;
    node.slaves.clear();
    for (const auto &[slave, weight] : row.slaves)
      if (std::abs(weight) > 16 * std::numeric_limits<double>::epsilon())
        node.slaves.emplace_back(slave, weight);
  }
} // namespace conetact::pairing
