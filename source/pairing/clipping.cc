// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/clipping.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace conetact::pairing
{
  namespace
  {
    using dealii::Tensor;

    /** Overlaps of boxes below this part of their size are rounding. */
    constexpr double round_off = 1e-12;

    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    bool
    is_interval(const Polygon &polygon)
    {
      return polygon.size() == 2;
    }

    /* Both halves share the crossings to the last bit: pieces of a face add up
       to the face, and no sliver is counted twice or lost. */
    struct Halves
    {
      Polygon left, right; ///< of a line
    };

    /** Cuts a polygon along the line from a to b. */
    Halves
    cut(const Polygon &polygon, const Point<2> &a, const Point<2> &b)
    {
      Halves     halves;
      const auto side = [&](const Point<2> &p) { return cross(b - a, p - a); };
      for (std::size_t i = 0; i < polygon.size(); ++i)
        {
          const Point<2> &p  = polygon[i];
          const Point<2> &q  = polygon[(i + 1) % polygon.size()];
          const double    at = side(p), next = side(q);
          // A point on the line belongs to both sides.
          if (at >= 0)
            halves.left.push_back(p);
          if (at <= 0)
            halves.right.push_back(p);
          if ((at > 0 && next < 0) || (at < 0 && next > 0))
            {
              // The side is linear along the edge and vanishes there.
              const Point<2> crossing = p + at / (at - next) * (q - p);
              halves.left.push_back(crossing);
              halves.right.push_back(crossing);
            }
        }
      return halves;
    }

    Polygon
    interval(const double low, const double high)
    {
      return high > low ? Polygon{Point<2>(low, 0), Point<2>(high, 0)} :
                          Polygon();
    }

    /** Adds what is left of a polygon without another one. */
    void
    take_away(const Polygon        &polygon,
              const Polygon        &taken,
              std::vector<Polygon> &pieces)
    {
      // Polygons that touch along an edge leave two points, which are no
      // interval here.
      const auto keep = [&](const Polygon &piece) {
        if (is_interval(piece) == is_interval(polygon) &&
            measure(piece) > round_off * measure(polygon))
          pieces.push_back(piece);
      };
      if (is_interval(polygon))
        {
          keep(interval(polygon[0][0], std::min(polygon[1][0], taken[0][0])));
          keep(interval(std::max(polygon[0][0], taken[1][0]), polygon[1][0]));
          return;
        }
      // Pieces are right of an edge of the convex polygon that is taken, and
      // left of those before it: they are convex and do not overlap.
      Polygon rest = polygon;
      for (std::size_t i = 0; i < taken.size() && rest.size() > 2; ++i)
        {
          const Halves halves =
            cut(rest, taken[i], taken[(i + 1) % taken.size()]);
          keep(halves.right);
          rest = halves.left;
        }
    }

    /** Corners that coincide are one: an edge without length has no sides to
     * cut by. */
    void
    remove_repeated(Polygon &polygon)
    {
      constexpr double same = 1e-10;
      double           size = 0;
      for (const Point<2> &p : polygon)
        size = std::max(size, p.distance(polygon[0]));
      for (std::size_t i = polygon.size(); i > 0 && polygon.size() > 3; --i)
        if (polygon[i - 1].distance(polygon[i % polygon.size()]) <= same * size)
          polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i) - 1);
    }

    /**
     * The least and the largest of each coordinate: low x, high x, low y, high
     * y.
     */
    std::array<double, 4>
    box(const Polygon &polygon)
    {
      std::array<double, 4> b{
        {polygon[0][0], polygon[0][0], polygon[0][1], polygon[0][1]}};
      for (const Point<2> &p : polygon)
        for (unsigned int d = 0; d < 2; ++d)
          {
            b[2 * d]     = std::min(b[2 * d], p[d]);
            b[2 * d + 1] = std::max(b[2 * d + 1], p[d]);
          }
      return b;
    }

    void
    add_triangle(const Point<2>          &a,
                 const Point<2>          &b,
                 const Point<2>          &c,
                 const unsigned int       level,
                 std::vector<PlanePoint> &points)
    {
      // Products of two linear functions need degree 2, of two bilinear ones
      // on parallelograms 4; what is beyond is for skew faces.
      static const dealii::QWitherdenVincentSimplex<2> degree_5(3),
        degree_13(7);
      // dA = |J| da db, where |J| is twice the area; the weights of a rule sum
      // to 1/2.
      const double jacobian = cross(b - a, c - a);
      // Three corners on a line have no area.
      if (!(jacobian > 0))
        return;
      // A series of high order is summed on smaller triangles.
      if (level > 1)
        {
          const Point<2> ab = a + .5 * (b - a), bc = b + .5 * (c - b),
                         ca = c + .5 * (a - c);
          for (const auto &[p, q, r] : {std::array<Point<2>, 3>{{a, ab, ca}},
                                        {{ab, b, bc}},
                                        {{ca, bc, c}},
                                        {{ab, bc, ca}}})
            add_triangle(p, q, r, level - 1, points);
          return;
        }
      const auto &rule = level > 0 ? degree_13 : degree_5;
      for (unsigned int q = 0; q < rule.size(); ++q)
        points.push_back(
          {a + rule.point(q)[0] * (b - a) + rule.point(q)[1] * (c - a),
           rule.weight(q) * jacobian});
    }
  } // namespace

  Polygon
  oriented(Polygon polygon)
  {
    if (!is_interval(polygon))
      remove_repeated(polygon);
    if (is_interval(polygon) ? polygon[0][0] > polygon[1][0] :
                               measure(polygon) < 0)
      std::reverse(polygon.begin(), polygon.end());
    return polygon;
  }

  double
  measure(const Polygon &polygon)
  {
    if (polygon.size() < 2)
      return 0;
    if (is_interval(polygon))
      return polygon[1][0] - polygon[0][0];
    // The triangles are those about a corner, not about the origin, which may
    // be far: a difference of large areas would lose digits. The sum is
    // negative for clockwise polygons, which is how oriented() knows them.
    double twice = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
      twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return .5 * twice;
  }

  /* The mean of the corners, which is inside of a convex polygon. It is not the
     centre of its area, and need not be. */
  Point<2>
  middle(const Polygon &polygon)
  {
    Assert(!polygon.empty(),
           dealii::ExcMessage("An empty polygon has no middle."));
    Point<2> sum;
    for (const Point<2> &p : polygon)
      sum += Tensor<1, 2>(p) / static_cast<double>(polygon.size());
    return sum;
  }

  double
  distance(const Polygon &polygon, const Point<2> &p)
  {
    Assert(!polygon.empty(),
           dealii::ExcMessage("An empty polygon is nowhere."));
    if (polygon.empty())
      return std::numeric_limits<double>::max();
    if (is_interval(polygon))
      return std::max({polygon[0][0] - p[0], p[0] - polygon[1][0], 0.});
    bool   inside  = true;
    double nearest = polygon[0].distance(p);
    for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const Point<2>    &a      = polygon[i];
        const Tensor<1, 2> edge   = polygon[(i + 1) % polygon.size()] - a;
        const double       square = edge.norm_square();
        // An edge of no length has no side.
        if (std::sqrt(square) <= round_off * p.distance(a))
          continue;
        inside             = inside && cross(edge, p - a) >= 0;
        const double along = std::clamp((p - a) * edge / square, 0., 1.);
        nearest            = std::min(nearest, (a + along * edge).distance(p));
      }
    return inside ? 0 : nearest;
  }

  Polygon
  common_part(const Polygon &one, const Polygon &other)
  {
    Assert(
      one.empty() || other.empty() || (one.size() == 2) == (other.size() == 2),
      dealii::ExcMessage("Intervals meet intervals, and polygons polygons."));
    if (one.empty() || other.empty())
      return {};
    if (is_interval(one))
      return interval(std::max(one[0][0], other[0][0]),
                      std::min(one[1][0], other[1][0]));
    // Sutherland and Hodgman: both are convex, so their common part is what is
    // left of all edges of one of them.
    Polygon rest = one;
    for (std::size_t i = 0; i < other.size() && !rest.empty(); ++i)
      rest = cut(rest, other[i], other[(i + 1) % other.size()]).left;
    return rest.size() < 3 ? Polygon() : rest;
  }

  std::vector<Polygon>
  without(const std::vector<Polygon> &polygons, const Polygon &taken)
  {
    std::vector<Polygon> pieces;
    for (const Polygon &polygon : polygons)
      if (boxes_overlap(polygon, taken) &&
          measure(common_part(polygon, taken)) > round_off * measure(polygon))
        take_away(polygon, taken, pieces);
      else // neighbours stay whole
        pieces.push_back(polygon);
    return pieces;
  }

  bool
  boxes_overlap(const Polygon &one, const Polygon &other)
  {
    if (one.empty() || other.empty())
      return false;
    const auto         a = box(one), b = box(other);
    const unsigned int n_axes = is_interval(one) ? 1 : 2;
    for (unsigned int d = 0; d < n_axes; ++d)
      {
        const double size =
          std::min(a[2 * d + 1] - a[2 * d], b[2 * d + 1] - b[2 * d]);
        const double common =
          std::min(a[2 * d + 1], b[2 * d + 1]) - std::max(a[2 * d], b[2 * d]);
        // Neighbours that touch along an edge do not overlap.
        if (common <= round_off * size)
          return false;
      }
    return true;
  }

  std::vector<PlanePoint>
  gauss_points(const Polygon &polygon, const unsigned int level)
  {
    // Three points are exact to degree 5, more than products of two functions
    // of second degree on straight segments need.
    static const dealii::QGauss<1> on_lines(3);
    std::vector<PlanePoint>        points;
    if (is_interval(polygon))
      for (unsigned int q = 0; q < on_lines.size(); ++q)
        points.push_back(
          {polygon[0] + on_lines.point(q)[0] * (polygon[1] - polygon[0]),
           on_lines.weight(q) * measure(polygon)});
    else // a fan of triangles: the polygon is convex
      for (std::size_t i = 2; i < polygon.size(); ++i)
        add_triangle(polygon[0], polygon[i - 1], polygon[i], level, points);
    return points;
  }
} // namespace conetact::pairing
