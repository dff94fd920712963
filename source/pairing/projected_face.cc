// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/projected_face.h"

#include "conetact/pairing/closest_point.h"
#include "conetact/pairing/nodal_shapes.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  ProjectionPlane::ProjectionPlane(const Point<3>     &through,
                                   const Tensor<1, 3> &unit_normal,
                                   const bool          is_line)
    : origin(through)
    , normal(unit_normal)
  {
    Assert(std::abs(normal.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    Tensor<1, 3> up;
    // The axis that the normal has least of is furthest from it; of a line it
    // is z, so that the first axis is in the plane of the line.
    unsigned int least = 2;
    if (!is_line)
      for (unsigned int d = 0; d < 2; ++d)
        if (std::abs(normal[d]) < std::abs(normal[least]))
          least = d;
    up[least] = 1;
    axes[0]   = cross_product_3d(up, normal);
    axes[0] /= axes[0].norm();
    axes[1] = cross_product_3d(normal, axes[0]);
  }

  Point<2>
  ProjectionPlane::project(const Point<3> &p) const
  {
    return {(p - origin) * axes[0], (p - origin) * axes[1]};
  }

  /* Along the normal, which looks out of the slave: the gap is the height of
     the master less that of the slave. */
  double
  ProjectionPlane::height(const Point<3> &p) const
  {
    return (p - origin) * normal;
  }

  Tensor<1, 3>
  ProjectionPlane::in_space(const Eigen::Vector3d &v) const
  {
    return v[0] * axes[0] + v[1] * axes[1] + v[2] * normal;
  }


  ProjectedFace::ProjectedFace(const std::vector<Point<3>> &x,
                               const ProjectionPlane       &plane)
  {
    Assert(x.size() >= 2 && x.size() <= 4,
           dealii::ExcMessage(
             "Faces are segments, triangles or quadrilaterals."));
    for (const Point<3> &corner : x)
      {
        corners.push_back(plane.project(corner));
        heights.push_back(plane.height(corner));
      }
    around = corners;
    // A segment is an interval of the first axis.
    if (x.size() == 2)
      for (Point<2> &end : around)
        end[1] = 0;
    if (x.size() == 4)
      {
        constexpr double round_off = 1e-12;
        // Without twist and warp the bilinear map is affine, and shape
        // functions are polynomials of the plane, too.
        const dealii::Tensor<1, 2> twist =
          (corners[3] - corners[2]) - (corners[1] - corners[0]);
        const double warp = heights[3] - heights[2] - heights[1] + heights[0];
        const double size = corners[0].distance(corners[3]);
        skew              = (twist.norm() + std::abs(warp)) / size;
        if (skew <= round_off)
          skew = 0;
        // deal.II numbers corners line by line, an outline goes round.
        std::swap(around[2], around[3]);
      }
    around = oriented(around);
  }

  ProjectedFace::ProjectedFace(const FaceNet::Face   &face,
                               const ProjectionPlane &plane)
    : ProjectedFace(face.corners, plane)
  {
    if (face.middles.empty())
      return;
    for (const auto *const places : {&face.corners, &face.middles})
      for (const Point<3> &p : *places)
        {
          const Point<2> q = plane.project(p);
          bent.emplace_back(q[0], q[1], plane.height(p));
        }
  }

  /** Derivatives of x(a, b) = x_0 + a (x_1 - x_0) + b (x_2 - x_0) + a b twist,
   * twist = x_3 - x_2 - x_1 + x_0 (0 of a triangle), in axes of the plane. */
  Eigen::Matrix<double, 3, 2>
  ProjectedFace::slopes(const std::array<double, 2> &at) const
  {
    const auto corner = [&](const std::size_t i) {
      return Eigen::Vector3d(corners[i][0], corners[i][1], heights[i]);
    };
    Eigen::Matrix<double, 3, 2> result;
    const Eigen::Vector3d       along_a = corner(1) - corner(0);
    result.col(0)                       = along_a;
    // A segment has one direction only; the other one makes the map regular.
    if (n_corners() == 2)
      result.col(1) = Eigen::Vector3d::UnitY();
    else
      result.col(1) = corner(2) - corner(0);
    if (n_corners() == 4)
      {
        const Eigen::Vector3d twist = corner(3) - corner(2) - along_a;
        result.col(0) += at[1] * twist;
        result.col(1) += at[0] * twist;
      }
    return result;
  }

  /** The local coordinates of the point that is seen, by Newton's method: one
   * step where the face is affine. */
  std::array<double, 2>
  ProjectedFace::local(const Point<2> &p) const
  {
    if (n_corners() == 2)
      return {{(p[0] - corners[0][0]) / (corners[1][0] - corners[0][0]), 0}};
    // The iteration begins at the centre: the face looks convex, hence the map
    // has an inverse there and on the way to any of its points.
    std::array<double, 2> at = {{.5, .5}};
    for (unsigned int step = 0; step < 20; ++step)
      {
        const auto      N = shape_values(n_corners(), at);
        Eigen::Vector2d miss(p[0], p[1]);
        for (std::size_t i = 0; i < n_corners(); ++i)
          miss -= N[i] * Eigen::Vector2d(corners[i][0], corners[i][1]);
        const Eigen::Vector2d d = slopes(at).topRows<2>().inverse() * miss;
        at                      = {{at[0] + d[0], at[1] + d[1]}};
        if (skew == 0 || d.norm() < 1e-13)
          break;
      }
    return at;
  }

  ProjectedFace::Seen
  ProjectedFace::at(const Point<2> &p) const
  {
    return bent.empty() ? flat_at(local(p), p) : bent_at(local(p));
  }

  ProjectedFace::Seen
  ProjectedFace::over(const Point<2> &p) const
  {
    return bent.empty() ? flat_at(local(p), p) :
                          bent_at(bent_local(p, local(p)));
  }

  ProjectedFace::Seen
  ProjectedFace::flat_at(const std::array<double, 2> &where,
                         const Point<2>              &p) const
  {
    Seen seen;
    seen.local = where;
    seen.place = p;
    seen.shape = Eigen::Vector4d(shape_values(n_corners(), where).data());
    for (std::size_t i = 0; i < n_corners(); ++i)
      seen.height += seen.shape[static_cast<Eigen::Index>(i)] * heights[i];
    // The area of the face over that of its shadow is |dx/da x dx/db| over its
    // part in the plane.
    const auto g = slopes(where);
    seen.stretch = n_corners() == 2 ? std::hypot(1, g(2, 0) / g(0, 0)) :
                                      g.col(0).cross(g.col(1)).norm() /
                                        std::abs(g.topRows<2>().determinant());
    return seen;
  }

  ProjectedFace::BentPlace
  ProjectedFace::bent_place(const std::array<double, 2> &at) const
  {
    Assert(!bent.empty(),
           dealii::ExcMessage("Only bent faces have nodes besides corners."));
    const auto N     = nodal_shape_values(bent.size(), n_corners(), at);
    const auto slope = nodal_shape_slopes(bent.size(), n_corners(), at);
    BentPlace  place;
    for (std::size_t i = 0; i < bent.size(); ++i)
      {
        place.x += N[i] * bent[i];
        place.slopes.col(0) += slope[0][i] * bent[i];
        place.slopes.col(1) += slope[1][i] * bent[i];
      }
    if (n_corners() == 2)
      place.slopes.col(1) = Eigen::Vector3d::UnitY();
    return place;
  }

  /**
   * The local coordinates of a point of a bent face that is over one of the
   * plane, by Newton's method: where the face stands askew its edges bend in
   * the plane, too. What is far off, or has no end, stays what it is between
   * chords.
   */
  std::array<double, 2>
  ProjectedFace::bent_local(const Point<2>              &p,
                            const std::array<double, 2> &near) const
  {
    constexpr double found = 1e-13, far = .2;
    auto             at = near;
    for (unsigned int step = 0; step < 10; ++step)
      {
        const BentPlace       there = bent_place(at);
        const Eigen::Vector2d miss(p[0] - there.x[0],
                                   n_corners() == 2 ? 0 : p[1] - there.x[1]);
        const Eigen::Vector2d d = there.slopes.topRows<2>().inverse() * miss;
        at                      = {{at[0] + d[0], at[1] + d[1]}};
        if (!(std::hypot(at[0] - near[0], at[1] - near[1]) < far))
          return near;
        if (d.norm() < found)
          return at;
      }
    return near;
  }

  ProjectedFace::Seen
  ProjectedFace::bent_at(const std::array<double, 2> &where) const
  {
    const BentPlace       there = bent_place(where);
    const Eigen::Vector3d across =
      there.slopes.col(0).cross(there.slopes.col(1));
    Seen seen;
    seen.local  = where;
    seen.place  = {there.x[0], n_corners() == 2 ? 0 : there.x[1]};
    seen.shape  = Eigen::Vector4d(shape_values(n_corners(), where).data());
    seen.height = there.x[2];
    seen.normal = (across[2] < 0 ? -1 : 1) / across.norm() * across;
    // A point of the plane has the local coordinates of the chords: its dA is
    // da db times their determinant, whatever the bent edges do.
    seen.stretch =
      across.norm() / std::abs(slopes(where).topRows<2>().determinant());
    return seen;
  }

  Eigen::VectorXd
  nodal_shapes(const FaceNet::Face &face, const ProjectedFace::Seen &seen)
  {
    const std::size_t n    = face.nodes.size();
    const auto        size = static_cast<Eigen::Index>(n);
    if (n == face.corners.size())
      return seen.shape.head(size);
    const auto N = nodal_shape_values(n, face.corners.size(), seen.local);
    return Eigen::Map<const Eigen::VectorXd>(N.data(), size);
  }
} // namespace conetact::pairing
