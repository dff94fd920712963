// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/closest_point.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    Tensor<1, 3>
    image(const std::vector<Point<3>> &x, const std::array<double, 2> &at)
    {
      Tensor<1, 3> sum;
      const auto   weights = shape_values(x.size(), at);
      for (std::size_t i = 0; i < x.size(); ++i)
        sum += weights[i] * Tensor<1, 3>(x[i]);
      return sum;
    }

    /** Tangent vectors of a triangle or a bilinear face. */
    std::array<Tensor<1, 3>, 2>
    face_tangents(const std::vector<Point<3>> &x,
                  const std::array<double, 2> &at)
    {
      if (x.size() == 3)
        return {{x[1] - x[0], x[2] - x[0]}};
      const auto [a, b] = at;
      return {{(1 - b) * (x[1] - x[0]) + b * (x[3] - x[2]),
               (1 - a) * (x[2] - x[0]) + a * (x[3] - x[1])}};
    }

    double
    closest_on_segment(const Point<3> &x, const Point<3> &y, const Point<3> &p)
    {
      const Tensor<1, 3> along = y - x;
      return std::clamp((p - x) * along / along.norm_square(), 0., 1.);
    }

    /** The nearest point of the edges, which are straight. */
    std::array<double, 2>
    closest_on_edges(const std::vector<Point<3>> &x, const Point<3> &p)
    {
      const auto on_edge = [&](const std::size_t i, const std::size_t j) {
        return closest_on_segment(x[i], x[j], p);
      };
      std::vector<std::array<double, 2>> candidates = {{{0, on_edge(0, 2)}},
                                                       {{on_edge(0, 1), 0}}};
      if (x.size() == 3)
        candidates.push_back({{1 - on_edge(1, 2), on_edge(1, 2)}});
      else
        {
          candidates.push_back({{1, on_edge(1, 3)}});
          candidates.push_back({{on_edge(2, 3), 1}});
        }
      const auto distance = [&](const std::array<double, 2> &at) {
        return (Tensor<1, 3>(p) - image(x, at)).norm_square();
      };
      return *std::min_element(candidates.begin(),
                               candidates.end(),
                               [&](const auto &a, const auto &b) {
                                 return distance(a) < distance(b);
                               });
    }

    /**
     * The foot in a triangle's plane, by its normal equations. Where it is
     * outside, the nearest point is on an edge: the centre stands for it, which
     * is never nearer.
     */
    std::array<double, 2>
    closest_inside_triangle(const std::vector<Point<3>> &x, const Point<3> &p)
    {
      const Tensor<1, 3> e = x[1] - x[0], f = x[2] - x[0], d = p - x[0];
      const double       ee = e * e, ef = e * f, ff = f * f;
      const double       det = ee * ff - ef * ef;
      const double       a   = ((e * d) * ff - (f * d) * ef) / det;
      const double       b   = ((f * d) * ee - (e * d) * ef) / det;
      if (a >= 0 && b >= 0 && a + b <= 1)
        return {{a, b}};
      return {{1. / 3, 1. / 3}};
    }

    /**
     * Newton's step for |p - x(a, b)|^2 / 2, whose second derivatives are x_i .
     * x_j - (p - x) . x_ij; Gauss and Newton's, without x_ij, where the face is
     * so warped that the former would lead to a maximum.
     */
    std::array<double, 2>
    newton_step(const std::vector<Point<3>> &x,
                const std::array<double, 2> &at,
                const Tensor<1, 3>          &miss)
    {
      const auto g = face_tangents(x, at);
      // The mixed second derivative of a bilinear face is the only one that is
      // not zero; it is the same everywhere.
      const Tensor<1, 3> twist = (x[3] - x[2]) - (x[1] - x[0]);
      const double       g00 = g[0] * g[0], g11 = g[1] * g[1];
      const double       m0 = miss * g[0], m1 = miss * g[1];
      for (const double curvature : {miss * twist, 0.})
        {
          const double g01 = g[0] * g[1] - curvature;
          const double det = g00 * g11 - g01 * g01;
          // A minimum only if the matrix is positive definite.
          if (det > 1e-12 * g00 * g11)
            return {{(m0 * g11 - m1 * g01) / det, (m1 * g00 - m0 * g01) / det}};
        }
      return {{0, 0}}; // no area there: the edges have the nearest point
    }

    /** Finds the nearest point inside a bilinear face by Newton's method,
     * damped and kept inside; the edges are looked at apart. */
    std::array<double, 2>
    closest_inside(const std::vector<Point<3>> &x, const Point<3> &p)
    {
      std::array<double, 2> at   = {{.5, .5}};
      Tensor<1, 3>          miss = Tensor<1, 3>(p) - image(x, at);
      for (unsigned int iteration = 0; iteration < 50; ++iteration)
        {
          const auto step   = newton_step(x, at, miss);
          auto       next   = at;
          auto       next_m = miss;
          for (double length = 1; length > 1e-3; length /= 2)
            {
              for (unsigned int d = 0; d < 2; ++d)
                // Outside the face the continued surface may come nearer to p.
                next[d] = std::clamp(at[d] + length * step[d], 0., 1.);
              next_m = Tensor<1, 3>(p) - image(x, next);
              if (next_m.norm_square() <= miss.norm_square())
                break;
            }
          const double moved =
            std::abs(next[0] - at[0]) + std::abs(next[1] - at[1]);
          if (next_m.norm_square() > miss.norm_square())
            break;
          at   = next;
          miss = next_m;
          if (moved < 1e-15)
            break;
        }
      return at;
    }
  } // namespace

  /* Linear functions of segments and triangles, bilinear ones of
     quadrilaterals, whose corners stand row by row, as deal.II counts them. */
  std::array<double, 4>
  shape_values(const std::size_t n_corners, const std::array<double, 2> &at)
  {
    Assert(n_corners >= 2 && n_corners <= 4,
           dealii::ExcMessage("Faces have two to four corners."));
    const auto [a, b] = at;
    if (n_corners == 2)
      return {{1 - a, a, 0, 0}};
    if (n_corners == 3)
      return {{1 - a - b, a, b, 0}};
    return {{(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b}};
  }

  Tensor<1, 3>
  face_normal_at(const std::vector<Point<3>> &corners,
                 const std::array<double, 2> &at)
  {
    Assert(corners.size() >= 2 && corners.size() <= 4,
           dealii::ExcMessage("Faces have two to four corners."));
    Tensor<1, 3> normal;
    if (corners.size() == 2)
      {
        const Tensor<1, 3> along = corners[1] - corners[0];
        normal                   = Tensor<1, 3>({along[1], -along[0], 0.});
      }
    else
      {
        const auto g = face_tangents(corners, at);
        normal       = cross_product_3d(g[0], g[1]);
      }
    return normal / normal.norm();
  }

  ClosestPoint
  closest_point(const std::vector<Point<3>> &corners, const Point<3> &p)
  {
    Assert(corners.size() >= 2 && corners.size() <= 4,
           dealii::ExcMessage("Faces have two to four corners."));
    const auto result = [&](const std::array<double, 2> &at) {
      const Point<3> point(image(corners, at));
      return ClosestPoint{at, point, point.distance(p)};
    };
    if (corners.size() == 2)
      return result({{closest_on_segment(corners[0], corners[1], p), 0}});
    // The distance has few minima: one inside, or those of the edges.
    const ClosestPoint on_edge = result(closest_on_edges(corners, p));
    const ClosestPoint inside =
      result(corners.size() == 3 ? closest_inside_triangle(corners, p) :
                                   closest_inside(corners, p));
    // A tie goes to the edge, where the faces beside have a say.
    return on_edge.distance <= inside.distance ? on_edge : inside;
  }

  std::optional<std::array<double, 2>>
  point_along(const std::vector<Point<3>> &corners,
              const Point<3>              &p,
              const Tensor<1, 3>          &normal,
              const std::array<double, 2> &near)
  {
    Assert(std::abs(normal.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    if (corners.size() == 2)
      {
        const Tensor<1, 3> along = corners[1] - corners[0];
        // In the plane: x_0 + a along + s n = p, times the vector across n.
        const double across = cross_product_3d(along, normal)[2];
        // The normal lies in the face: no point of it is along.
        if (std::abs(across) < 1e-6 * along.norm())
          return {};
        return {{{cross_product_3d(p - corners[0], normal)[2] / across, 0}}};
      }
    // x(a, b) + s n = p: products with n leave two equations for a and b.
    // Steps fall to the rounding of places over the size of the face.
    constexpr double exact = 1e-14, enough = 1e-9;
    auto             at   = near;
    double           step = 1;
    for (unsigned int iteration = 0; iteration < 20 && step >= exact;
         ++iteration)
      {
        const auto         g    = face_tangents(corners, at);
        const Tensor<1, 3> miss = Tensor<1, 3>(p) - image(corners, at);
        const double       det  = cross_product_3d(g[0], g[1]) * normal;
        if (std::abs(det) < 1e-6 * g[0].norm() * g[1].norm())
          return {};
        const double da = cross_product_3d(miss, g[1]) * normal / det;
        const double db = cross_product_3d(g[0], miss) * normal / det;
        at              = {{at[0] + da, at[1] + db}};
        step            = std::abs(da) + std::abs(db);
      }
    return step < enough ? std::optional(at) : std::nullopt;
  }

  /* A segment has a length. Of a quadrilateral half the product of its
     diagonals: exact where it is plane, and of a warped one the area of its
     projection along its mean normal. */
  double
  face_area(const std::vector<Point<3>> &x)
  {
    if (x.size() == 2)
      return x[0].distance(x[1]);
    if (x.size() == 3)
      return .5 * cross_product_3d(x[1] - x[0], x[2] - x[0]).norm();
    return .5 * cross_product_3d(x[3] - x[0], x[2] - x[1]).norm();
  }

  void
  for_each_edge(
    const std::size_t                                                n_corners,
    const std::function<void(const std::size_t, const std::size_t)> &visit)
  {
    visit(0, 1);
    if (n_corners > 2)
      visit(0, 2);
    if (n_corners == 3)
      visit(1, 2);
    if (n_corners == 4) // which stand row by row
      {
        visit(1, 3);
        visit(2, 3);
      }
  }

  Tensor<1, 3>
  nearest_in_cone(const Tensor<1, 3>              &direction,
                  const std::vector<Tensor<1, 3>> &cone)
  {
    // The projection of a unit vector onto a convex cone is the longest of its
    // projections onto edges, onto sides between two of them and into the cone
    // between three, as far as these are in the cone themselves.
    constexpr double parallel = 1e-9, outside = -1e-14;
    Tensor<1, 3>     best;
    const auto       offer = [&](const Tensor<1, 3> &v) {
      if (v.norm() > best.norm())
        best = v;
    };
    const std::size_t n = cone.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        if (const double along = direction * cone[i]; along > 0)
          offer(along * cone[i]);
        for (std::size_t j = 0; j < i; ++j)
          {
            const Tensor<1, 3> c = cross_product_3d(cone[i], cone[j]);
            if (c.norm() < parallel)
              continue;
            const Tensor<1, 3> on_side =
              direction - (direction * c) / c.norm_square() * c;
            if (cross_product_3d(cone[i], on_side) * c >= outside &&
                cross_product_3d(on_side, cone[j]) * c >= outside)
              offer(on_side);
            for (std::size_t k = 0; k < j; ++k)
              {
                const double whole = c * cone[k];
                const auto   part  = [&](const std::size_t a,
                                      const std::size_t b) {
                  return cross_product_3d(cone[a], cone[b]) * direction * whole;
                };
                if (std::abs(whole) > parallel && part(i, j) >= outside &&
                    part(j, k) >= outside && part(k, i) >= outside)
                  offer(direction);
              }
          }
      }
    return best;
  }
} // namespace conetact::pairing
