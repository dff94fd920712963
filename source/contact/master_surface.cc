// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/master_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace conetact
{
  namespace
  {
    /** Misses below this part of a face's size are round-off. */
    constexpr double round_off = 1e-8;

    /** Q1 shape functions on [0,1]^(dim-1) in the order of the nodes. */
    std::vector<double>
    shapes(const std::size_t n, const double a, const double b)
    {
      if (n == 2)
        return {1 - a, a};
      return {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
    }

    template <typename Corners>
    Tensor<1, 3>
    combine(const Corners &corners, const std::vector<double> &weights)
    {
      Tensor<1, 3> sum;
      for (std::size_t i = 0; i < corners.size(); ++i)
        sum += weights[i] * Tensor<1, 3>(corners[i]);
      return sum;
    }

    /** Tangent vectors of a bilinear face at (a, b). */
    std::array<Tensor<1, 3>, 2>
    face_tangents(const std::vector<Point<3>> &x,
                  const double                 a,
                  const double                 b)
    {
      return {{(1 - b) * (x[1] - x[0]) + b * (x[3] - x[2]),
               (1 - a) * (x[2] - x[0]) + a * (x[3] - x[1])}};
    }

    /** Closest point of a bilinear face: Gauss-Newton with clamping. */
    std::array<double, 2>
    closest_on_quadrilateral(const std::vector<Point<3>> &x, const Point<3> &p)
    {
      double a = .5, b = .5;
      for (unsigned int step = 0; step < 50; ++step)
        {
          const auto         g = face_tangents(x, a, b);
          const Tensor<1, 3> miss =
            Tensor<1, 3>(p) - combine(x, shapes(4, a, b));
          const double g00 = g[0] * g[0], g01 = g[0] * g[1], g11 = g[1] * g[1];
          const double det = g00 * g11 - g01 * g01;
          double       da  = ((miss * g[0]) * g11 - (miss * g[1]) * g01) / det;
          double       db  = ((miss * g[1]) * g00 - (miss * g[0]) * g01) / det;
          // at a bound that the step would cross, move along it only
          if ((a == 0 && da < 0) || (a == 1 && da > 0))
            {
              da = 0;
              db = (miss * g[1]) / g11;
            }
          if ((b == 0 && db < 0) || (b == 1 && db > 0))
            {
              db = 0;
              da = (a == 0 || a == 1) && da == 0 ? 0 : (miss * g[0]) / g00;
            }
          const double a_new = std::clamp(a + da, 0., 1.);
          const double b_new = std::clamp(b + db, 0., 1.);
          const double moved = std::abs(a_new - a) + std::abs(b_new - b);
          a                  = a_new;
          b                  = b_new;
          if (moved < 1e-15)
            break;
        }
      return {{a, b}};
    }
  } // namespace

  MasterSurface::MasterSurface(const Structure &body, const BoundaryIds &ids)
    : n_faces_at_node(body.n_nodes(), 0)
  {
    const Surface             surface = body.surface(ids);
    std::vector<Tensor<1, 3>> normals(body.n_nodes());
    for (const SurfaceNode &node : surface.nodes)
      normals[node.node] = node.normal;
    for (const SurfaceFace &f : surface.faces)
      {
        Face face;
        face.nodes = f.nodes;
        for (const unsigned int node : f.nodes)
          {
            face.corners.push_back(body.position(node));
            if (!surface.two_sided)
              face.outward += normals[node];
            ++n_faces_at_node[node];
          }
        for (const Point<3> &corner : face.corners)
          face.centre +=
            Tensor<1, 3>(corner) / static_cast<double>(face.corners.size());
        face.size = face.corners.front().distance(face.corners.back());
        faces.push_back(face);
      }
  }

  bool
  MasterSurface::is_rim(const Face                &face,
                        const std::vector<double> &weights) const
  {
    // inside the surface two faces share an end (2D), two an edge and four a
    // corner (3D)
    const unsigned int whole = face.nodes.size() == 2 ? 2 : 4;
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > round_off && n_faces_at_node[face.nodes[i]] < whole)
        return true;
    return false;
  }

  MasterSurface::Projection
  MasterSurface::project(const Face &face, const Point<3> &p) const
  {
    Projection   result;
    const auto  &x = face.corners;
    Tensor<1, 3> normal;
    if (x.size() == 2)
      {
        const Tensor<1, 3> along = x[1] - x[0];
        const double       a =
          std::clamp((p - x[0]) * along / along.norm_square(), 0., 1.);
        result.weights = shapes(2, a, 0);
        normal         = Tensor<1, 3>({along[1], -along[0], 0.});
      }
    else
      {
        const auto [a, b] = closest_on_quadrilateral(x, p);
        const auto g      = face_tangents(x, a, b);
        result.weights    = shapes(4, a, b);
        normal            = cross_product_3d(g[0], g[1]);
      }
    result.normal = normal / normal.norm();
    result.point  = Point<3>(combine(x, result.weights));
    result.on_rim = is_rim(face, result.weights);
    return result;
  }

  std::optional<MasterSurface::Foot>
  MasterSurface::foot(const Point<3>     &p,
                      const Tensor<1, 3> &slave_normal,
                      const double        reach) const
  {
    std::optional<Foot> best;
    double              nearest = reach;
    for (const Face &face : faces)
      {
        if (face.centre.distance(p) - face.size > nearest)
          continue;
        Projection   on     = project(face, p);
        Tensor<1, 3> normal = on.normal;
        if (normal * slave_normal > 0)
          normal = -normal;
        if (normal * slave_normal > -1e-3 ||
            (face.outward.norm() > 0 && normal * face.outward <= 0))
          continue;
        const Tensor<1, 3> arm      = p - on.point;
        const double       distance = arm.norm();
        if (distance > nearest || (best && distance == nearest))
          continue;
        const double gap    = arm * normal;
        const double miss   = (arm - gap * normal).norm();
        const bool   beside = miss > round_off * face.size;
        if (beside && on.on_rim)
          continue;

        Foot foot{gap, normal, {}};
        if (beside)
          {
            foot.gap    = gap < 0 ? -distance : distance;
            foot.normal = arm / foot.gap;
          }
        for (std::size_t i = 0; i < face.nodes.size(); ++i)
          if (std::abs(on.weights[i]) > 1e-14)
            foot.masters.emplace_back(face.nodes[i], on.weights[i]);
        nearest = distance;
        best    = std::move(foot);
      }
    return best;
  }
} // namespace conetact
