// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/passages.h"

#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/closest_point.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace conetact::pairing
{
  namespace
  {
    /** A node that touches a face counts as outside at the start though it is
     * this part of the face's size inside. */
    constexpr double touching = 2e-3;
    /**
     * A node that crosses the plane of a face up to this part of its size
     * beside it goes through it: faces overlap, so that nothing slips through
     * between two of them.
     */
    constexpr double overlap = 1e-3;
    /** A node that is no deeper than this part of its way inside, at half of
     * that, slides along the boundary. */
    constexpr double skims = 1e-3;

    /** The place at a time, on the straight line from one place to the next. */
    Point<3>
    between(const std::vector<Point<3>> &places, const double when)
    {
      const std::size_t k =
        std::min(static_cast<std::size_t>(when), places.size() - 2);
      return places[k] +
             (when - static_cast<double>(k)) * (places[k + 1] - places[k]);
    }

    FaceTree::Ball
    ball_around(const std::vector<Point<3>> &points)
    {
      Point<3> low = points[0], high = points[0];
      for (const Point<3> &p : points)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], p[d]);
            high[d] = std::max(high[d], p[d]);
          }
      return {low + .5 * (high - low), .5 * low.distance(high)};
    }
  } // namespace

  MovingBoundary::MovingBoundary(const bodies::Structure   &body,
                                 const BodyWay             &way,
                                 const bodies::BoundaryIds &entries)
    : places(body.n_nodes())
    , middle(n_places)
  {
    const bodies::Surface boundary = body.surface(body.boundary_ids());
    const auto            n        = static_cast<double>(boundary.nodes.size());
    // Ways of all nodes are relative to the middle of the boundary: where both
    // bodies move together they are short and nearly straight, and the balls
    // around them are small.
    for (const bodies::SurfaceNode &node : boundary.nodes)
      for (unsigned int k = 0; k < n_places; ++k)
        middle[k] += Tensor<1, 3>(way.at(node.node, part(k))) / n;
    // Faces have hanging nodes as well, which surfaces leave out.
    for (const bodies::SurfaceFace &face : boundary.faces)
      for (const unsigned int node : face.nodes)
        if (places[node].empty())
          places[node] = places_of(way, node);
    std::set<std::vector<unsigned int>> may_be_entered;
    for (const bodies::SurfaceFace &face : body.surface(entries).faces)
      may_be_entered.insert(face.nodes);
    std::vector<FaceTree::Ball> balls;
    for (const bodies::SurfaceFace &face : boundary.faces)
      {
        add_face(body, face, may_be_entered.count(face.nodes) > 0);
        Places all;
        for (const unsigned int corner : faces.back().corners)
          all.insert(all.end(), places[corner].begin(), places[corner].end());
        balls.push_back(ball_around(all));
      }
    tree = FaceTree(balls);
  }

  double
  MovingBoundary::part(const unsigned int place)
  {
    AssertIndexRange(place, n_places);
    return static_cast<double>(place) / (n_places - 1);
  }

  MovingBoundary::Places
  MovingBoundary::places_of(const BodyWay &way, const unsigned int node) const
  {
    Places result;
    for (unsigned int k = 0; k < n_places; ++k)
      result.push_back(way.at(node, part(k)) - middle[k]);
    return result;
  }

  void
  MovingBoundary::add_face(const bodies::Structure   &body,
                           const bodies::SurfaceFace &from,
                           const bool                 may_be_entered)
  {
    Face face{from.nodes, 1, 0, may_be_entered};
    face.corners.resize(bodies::n_corners(body, from));
    std::vector<Point<3>> undeformed;
    for (const unsigned int corner : face.corners)
      {
        undeformed.push_back(body.position(corner));
        face.size =
          std::max(face.size, undeformed[0].distance(undeformed.back()));
      }
    // The point (.25, .25) is inside both the unit square and the unit
    // triangle.
    if (face_normal_at(undeformed, {{.25, .25}}) * from.normal < 0)
      face.side = -1;
    faces.push_back(std::move(face));
  }

  /* Faces move from place to place along straight lines, as nodes do: n_places
     of them make a turn smooth enough. */
  std::vector<Point<3>>
  MovingBoundary::corners_of(const Face &face, const double when) const
  {
    Assert(when >= 0 && when <= n_places - 1,
           dealii::ExcMessage("A way has a start and an end."));
    std::vector<Point<3>> corners;
    for (const unsigned int corner : face.corners)
      corners.push_back(between(places[corner], when));
    return corners;
  }

  Tensor<1, 3>
  MovingBoundary::normal_of(const Face &face, const double when) const
  {
    return face.side * face_normal_at(corners_of(face, when), {{.25, .25}});
  }

  /** The height over the plane of a face; below it, in the body, it is
   * negative. */
  double
  MovingBoundary::height(const Face   &face,
                         const Places &node,
                         const double  when) const
  {
    const Point<3> corner = between(places[face.corners[0]], when);
    return normal_of(face, when) * (between(node, when) - corner);
  }

  /** Tells whether a point in the plane of a face is in the face. */
  bool
  MovingBoundary::is_inside(const Face   &face,
                            const Places &node,
                            const double  when) const
  {
    const Point<3>     p = between(node, when);
    const Tensor<1, 3> n = normal_of(face, when);
    const Tensor<1, 3> miss =
      p - closest_point(corners_of(face, when), p).point;
    return (miss - (miss * n) * n).norm() <= overlap * face.size;
  }

  /**
   * Adds the times at which the height over the plane of a face changes its
   * sign while the node is within the face. Height zero is outside: a node that
   * only touches has not come in.
   */
  void
  MovingBoundary::find_crossings(const unsigned int     f,
                                 const Places          &node,
                                 std::vector<Crossing> &crossings) const
  {
    const Face &face   = faces[f];
    double      before = height(face, node, 0);
    if (before < 0 && before > -touching * face.size)
      before = 0;
    for (unsigned int k = 1; k < n_places; ++k)
      {
        const double now = height(face, node, k);
        if ((before >= 0) != (now >= 0))
          if (const double when = time_of_crossing(face, node, k, before, now);
              is_inside(face, node, when))
            crossings.push_back({when, f, now < 0});
        before = now;
      }
  }

  /**
   * The time between place k - 1 and place k at which the height vanishes, by
   * the regula falsi: it would be linear but for how the face turns and
   * stretches.
   */
  double
  MovingBoundary::time_of_crossing(const Face        &face,
                                   const Places      &node,
                                   const unsigned int k,
                                   const double       height_before,
                                   const double       height_now) const
  {
    constexpr unsigned int n_steps = 3; // of the regula falsi
    double a = k - 1., at_a = height_before, b = k, at_b = height_now;
    double when = a + at_a / (at_a - at_b);
    for (unsigned int i = 0; i < n_steps; ++i)
      {
        const double at = height(face, node, when);
        if ((at >= 0) == (at_a >= 0))
          {
            a    = when;
            at_a = at;
          }
        else
          {
            b    = when;
            at_b = at;
          }
        if (at_a != at_b)
          when = a + (b - a) * at_a / (at_a - at_b);
      }
    return when;
  }

  /** The distance from the boundary at the end, at most `depth`, which is that
   * below the face where the node came in. */
  double
  MovingBoundary::depth_at_end(double depth, const Point<3> &p) const
  {
    for (const std::size_t f : tree.near({p, std::max(depth, 0.)}))
      depth =
        std::min(depth,
                 closest_point(corners_of(faces[f], n_places - 1), p).distance);
    return depth;
  }

  /**
   * The thickness of the body around a node inside: its depth, and from there
   * on to the nearest face that looks the other way. One that is far beside the
   * depth is not looked for.
   */
  double
  MovingBoundary::thickness_at_end(const Passage  &passage,
                                   const Point<3> &p) const
  {
    constexpr double opposite = -.5; // cosine
    constexpr double far      = 8;   // of the depth
    double           beyond   = std::numeric_limits<double>::max();
    for (const std::size_t f :
         tree.near({p, far * std::max(passage.depth, 0.)}))
      if (normal_of(faces[f], n_places - 1) * passage.entered < opposite)
        beyond = std::min(
          beyond,
          closest_point(corners_of(faces[f], n_places - 1), p).distance);
    return passage.depth + beyond;
  }

  Passage
  MovingBoundary::passage(const Crossing &in,
                          const Crossing *out,
                          const Places   &node) const
  {
    constexpr unsigned int last = n_places - 1;
    const Face            &face = faces[in.face];
    Passage                found{normal_of(face, last), {}, 0, face.size};
    if (out == nullptr)
      {
        found.depth     = depth_at_end(-height(face, node, last), node.back());
        found.thickness = thickness_at_end(found, node.back());
        return found;
      }
    const Face &other = faces[out->face];
    found.left        = normal_of(other, last);
    for (unsigned int k = 0; k < n_places; ++k)
      if (k > in.when && k < out->when)
        // A node between both faces is as deep as it is below the nearer one.
        found.depth =
          std::max(found.depth,
                   std::min(-height(face, node, k), -height(other, node, k)));
    return found;
  }

  /**
   * The face that may be entered and is nearest to a node at the start: nobody
   * knows how a node came in that is inside then, but it may have been there.
   */
  unsigned int
  MovingBoundary::nearest_entry(const Places &node) const
  {
    double       nearest = std::numeric_limits<double>::max();
    unsigned int entry   = 0;
    for (unsigned int f = 0; f < faces.size(); ++f)
      if (faces[f].may_be_entered)
        if (const double distance =
              closest_point(corners_of(faces[f], 0), node[0]).distance;
            distance < nearest)
          {
            nearest = distance;
            entry   = f;
          }
    return entry;
  }

  Passage
  MovingBoundary::passage_from_inside(const unsigned int entry,
                                      const Crossing    &out) const
  {
    constexpr unsigned int last = n_places - 1;
    return {normal_of(faces[entry], last),
            normal_of(faces[out.face], last),
            0,
            faces[entry].size};
  }

  /** Tells whether a node that seems to be inside slides along a face, as one
   * of a body that is flush with another. */
  bool
  MovingBoundary::slides_along(const Places &node,
                               const double  from,
                               const double  to) const
  {
    const Point<3> p = between(node, .5 * (from + to));
    const double   depth =
      skims * between(node, from).distance(between(node, to));
    const auto near = tree.near({p, depth});
    return std::any_of(near.begin(), near.end(), [&](const std::size_t f) {
      return closest_point(corners_of(faces[f], .5 * (from + to)), p)
               .distance <= depth;
    });
  }

  std::vector<Passage>
  MovingBoundary::passages(const BodyWay               &way,
                           const unsigned int           number,
                           std::optional<unsigned int> &inside_by) const
  {
    const Places          node = places_of(way, number);
    std::vector<Crossing> crossings;
    for (const std::size_t f : tree.near(ball_around(node)))
      find_crossings(static_cast<unsigned int>(f), node, crossings);
    std::sort(crossings.begin(),
              crossings.end(),
              [](const Crossing &one, const Crossing &other) {
                return one.when < other.when;
              });
    std::vector<Passage> found;
    // Without a crossing the node stays on its side, and `inside_by` with it.
    if (crossings.empty())
      return found;
    // A node that goes out first was inside at the start.
    if (!crossings[0].is_inwards && !slides_along(node, 0, crossings[0].when))
      found.push_back(
        passage_from_inside(inside_by ? *inside_by : nearest_entry(node),
                            crossings[0]));
    inside_by.reset();
    const Crossing *in = nullptr;
    for (const Crossing &crossing : crossings)
      if (in == nullptr && crossing.is_inwards &&
          faces[crossing.face].may_be_entered)
        in = &crossing;
      else if (in != nullptr && !crossing.is_inwards)
        {
          if (!slides_along(node, in->when, crossing.when))
            found.push_back(passage(*in, &crossing, node));
          in = nullptr;
        }
    if (in != nullptr)
      {
        found.push_back(passage(*in, nullptr, node));
        inside_by = in->face;
      }
    return found;
  }
} // namespace conetact::pairing
