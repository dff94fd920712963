// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/round_surface.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace conetact::pairing
{
  namespace
  {
    using Eigen::Index;
    using Points = std::vector<Point<3>>;
    using Axes   = std::vector<Tensor<1, 3>>;

    /** Of the radius: coordinates of files have as many digits. */
    constexpr double digits = 1e-6;

    Axes
    unit_axes(const unsigned int n)
    {
      Axes axes(n);
      for (unsigned int d = 0; d < n; ++d)
        axes[d][d] = 1;
      return axes;
    }

    /** The circle or sphere in the span of axes: of |x - c|^2 = r^2 the linear
     * unknowns are c and r^2 - c^2 (Kasa, IEEE Trans. Instrum. Meas. 25
     * (1976)). */
    RoundSurface
    nearest_round(const Points &points, const Axes &axes)
    {
      const auto      n = static_cast<Index>(axes.size());
      Eigen::MatrixXd rows(static_cast<Index>(points.size()), n + 1);
      Eigen::VectorXd squares(rows.rows());
      for (Index i = 0; i < rows.rows(); ++i)
        {
          for (Index k = 0; k < n; ++k)
            rows(i, k) = (points[static_cast<std::size_t>(i)] - points[0]) *
                         axes[static_cast<std::size_t>(k)];
          squares[i] = rows.row(i).head(n).squaredNorm();
          rows.row(i).head(n) *= 2;
          rows(i, n) = 1;
        }
      const Eigen::VectorXd x = rows.colPivHouseholderQr().solve(squares);
      RoundSurface          round{points[0], {}, 0};
      for (Index k = 0; k < n; ++k)
        round.centre += x[k] * axes[static_cast<std::size_t>(k)];
      round.radius = std::sqrt(std::max(0., x[n] + x.head(n).squaredNorm()));
      return round;
    }

    bool
    holds_all(const RoundSurface &round, const Points &points)
    {
      double extent = 0, off = 0;
      for (const Point<3> &p : points)
        {
          const auto across = [&](Tensor<1, 3> v) {
            v -= (v * round.axis) * round.axis;
            return v.norm();
          };
          off =
            std::max(off, std::abs(across(p - round.centre) - round.radius));
          extent = std::max(extent, across(p - points[0]));
        }
      // what is nearly flat has no centre that one could tell
      return round.radius <= extent && off <= digits * round.radius;
    }

    /** Whether faces are those of a polygon or so, not of a round mesh. */
    bool
    has_large_facets(const RoundSurface      &round,
                     const bodies::Surface   &surface,
                     const bodies::Structure &body)
    {
      constexpr double largest  = .9; // cosine, of 26 degrees
      const auto       is_large = [&](const bodies::SurfaceFace &face) {
        for (const unsigned int i : face.nodes)
          for (const unsigned int j : face.nodes)
            if (round.outward(body.position(i)) *
                  round.outward(body.position(j)) <
                largest)
              return true;
        return false;
      };
      return std::any_of(surface.faces.begin(), surface.faces.end(), is_large);
    }

    /** Two unit vectors across a third. */
    Axes
    across(const Tensor<1, 3> &axis)
    {
      Axes         all = unit_axes(3);
      Tensor<1, 3> least =
        *std::min_element(all.begin(), all.end(), [&](auto &a, auto &b) {
          return std::abs(a * axis) < std::abs(b * axis);
        });
      const Tensor<1, 3> u = cross_product_3d(axis, least);
      return {u / u.norm(), cross_product_3d(axis, u / u.norm())};
    }

    /** Normals of a cylinder are across its axis. */
    Tensor<1, 3>
    axis_across_normals(const bodies::Surface &surface)
    {
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (const bodies::SurfaceFace &face : surface.faces)
        {
          const Eigen::Vector3d n(face.normal[0],
                                  face.normal[1],
                                  face.normal[2]);
          sum += n * n.transpose();
        }
      const Eigen::Vector3d a =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(
          0);
      return Tensor<1, 3>({a[0], a[1], a[2]});
    }

    /** Facets know the axis nearly: steps of Gauss and Newton over its two
     * tilts, two ways across and the radius. */
    void
    improve(const Points &points, RoundSurface &round)
    {
      constexpr unsigned int steps = 6;
      for (unsigned int step = 0; step < steps; ++step)
        {
          const Axes      e = across(round.axis);
          Eigen::MatrixXd rows(static_cast<Index>(points.size()), 5);
          Eigen::VectorXd off(rows.rows());
          for (Index i = 0; i < rows.rows(); ++i)
            {
              const Point<3>    &p   = points[static_cast<std::size_t>(i)];
              const Tensor<1, 3> arm = p - round.centre;
              const Tensor<1, 3> out = round.outward(p);
              const double       z   = arm * round.axis / round.radius;
              off[i]                 = round.radius - arm * out;
              rows.row(i) << -z * (out * e[0]), -z * (out * e[1]), -out * e[0],
                -out * e[1], -1;
            }
          const Eigen::VectorXd x = rows.colPivHouseholderQr().solve(off);
          round.axis += (x[0] * e[0] + x[1] * e[1]) / round.radius;
          round.axis /= round.axis.norm();
          round.centre += x[2] * e[0] + x[3] * e[1];
          round.radius += x[4];
        }
    }
  } // namespace

  Tensor<1, 3>
  RoundSurface::outward(const Point<3> &p) const
  {
    Tensor<1, 3> arm = p - centre;
    arm -= (arm * axis) * axis;
    return arm.norm() > 0 ? Tensor<1, 3>(arm / arm.norm()) : arm;
  }

  bool
  RoundSurface::is_about_axis_of(const RoundSurface &other) const
  {
    Tensor<1, 3> apart = other.centre - centre;
    apart -= (apart * axis) * axis;
    const double r = std::min(radius, other.radius);
    return apart.norm() <= digits * r &&
           (axis - (axis * other.axis) * other.axis).norm() <= digits &&
           (axis.norm() > 0) == (other.axis.norm() > 0);
  }

  std::optional<RoundSurface>
  round_surface(const bodies::Structure   &body,
                const bodies::BoundaryIds &ids,
                const unsigned int         dim)
  {
    constexpr std::size_t few     = 6; // lie on some cylinder or other
    const bodies::Surface surface = body.surface(ids);
    Points                points;
    for (const bodies::SurfaceNode &node : surface.nodes)
      points.push_back(node.position);
    if (points.size() <= few || surface.faces.empty())
      return {};
    RoundSurface round = nearest_round(points, unit_axes(dim));
    if (dim == 2)
      round.axis[2] = 1;
    if (holds_all(round, points) && !has_large_facets(round, surface, body))
      return round;
    if (dim == 2)
      return {};
    const Tensor<1, 3> axis = axis_across_normals(surface);
    round                   = nearest_round(points, across(axis));
    round.axis              = axis;
    if (!(round.radius > 0) || !std::isfinite(round.radius))
      return {};
    improve(points, round);
    if (!holds_all(round, points) || has_large_facets(round, surface, body))
      return {};
    return round;
  }
} // namespace conetact::pairing
