// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/master_surface.h"

#include "conetact/pairing/bent_face.h"
#include "conetact/pairing/nodal_shapes.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    /** Misses below this part of a face's size are round-off. */
    constexpr double round_off = 1e-8;
    /**
     * How far beyond a rim or sharp edge a node is still over the face, in
     * face sizes: coordinates of mesh files have six to eight digits, and a
     * hundredth of a face more changes forces less than the mesh does.
     */
    constexpr double overhang = 1e-2;
    /**
     * Gaps below this part of a face's size have no direction of their own.
     */
    constexpr double touching = 1e-4;
    /**
     * A sharp edge is met by nodes that look at it, up to 20 degrees: facets
     * of curved slaves turn by as much. A wider cone would let the flat faces
     * of a slave run into edges beside them.
     */
    constexpr double cosine_to_edge = .94;

    /** The cosine of the smallest angle between a master's normal and the
     * normals of a slave, reversed. */
    double
    largest_cosine(const Tensor<1, 3>              &normal,
                   const std::vector<Tensor<1, 3>> &slave_normals)
    {
      double cosine = -1;
      for (const Tensor<1, 3> &n : slave_normals)
        cosine = std::max(cosine, -(normal * n));
      return cosine;
    }

    bodies::Surface
    whole_boundary(const bodies::Structure &body)
    {
      return body.surface(body.boundary_ids());
    }

    /**
     * Lines in space have normals all around: that towards the node, or against
     * its side where it is on the line.
     */
    void
    turn_around_line(const std::vector<Point<3>>     &corners,
                     const std::vector<Tensor<1, 3>> &slave_normals,
                     const Tensor<1, 3>              &arm,
                     Tensor<1, 3>                    &normal)
    {
      const Tensor<1, 3> line = corners[1] - corners[0];
      const double       size = line.norm();
      double             most = 0;
      const auto         take = [&](const Tensor<1, 3> &direction) {
        const Tensor<1, 3> across =
          direction - (direction * line / (size * size)) * line;
        if (across.norm() > most)
          {
            most   = across.norm();
            normal = across / most;
          }
      };
      take(arm);
      if (most > touching * size)
        return;
      most = 0;
      for (const Tensor<1, 3> &n : slave_normals)
        take(-n);
    }

    /**
     * Tells whether all that a node sees of a line is in the plane of x and y.
     */
    bool
    is_plane(const std::vector<Point<3>>     &corners,
             const std::vector<Tensor<1, 3>> &slave_normals,
             const Tensor<1, 3>              &arm)
    {
      return corners[0][2] == corners[1][2] && arm[2] == 0 &&
             std::all_of(slave_normals.begin(),
                         slave_normals.end(),
                         [](const Tensor<1, 3> &n) { return n[2] == 0; });
    }

    /**
     * A surface without sides looks against the node's side, or if that has
     * none either, at the node.
     */
    void
    turn_against(const std::vector<Tensor<1, 3>> &slave_normals,
                 const Tensor<1, 3>              &arm,
                 Tensor<1, 3>                    &normal)
    {
      const double forth = largest_cosine(normal, slave_normals);
      const double back  = largest_cosine(-normal, slave_normals);
      if (back > forth + round_off ||
          (back > forth - round_off && normal * arm < 0))
        normal = -normal;
    }

    /**
     * Where forces act on a face: they have no moment if that is along the
     * normal from p, a little beyond the face where p overhangs it.
     */
    std::array<double, 2>
    acting_at(const FaceNet::Face         &face,
              const Point<3>              &p,
              const Tensor<1, 3>          &normal,
              const std::array<double, 2> &closest)
    {
      const auto   along   = point_along(face.corners, p, normal, closest);
      const double allowed = 2 * overhang;
      const auto   is_near = [&](const double a) {
        return a >= -allowed && a <= 1 + allowed;
      };
      if (!along || !is_near((*along)[0]) || !is_near((*along)[1]))
        return closest;
      const bool is_triangle = face.corners.size() == 3;
      return is_triangle && !is_near((*along)[0] + (*along)[1]) ? closest :
                                                                  *along;
    }

    using Masters = std::vector<std::pair<unsigned int, double>>;

    Masters
    masters_at(const FaceNet::Face &face, const std::array<double, 2> &at)
    {
      constexpr double rounding = 1e-14;
      const auto       weights =
        nodal_shape_values(face.nodes.size(), face.corners.size(), at);
      Masters masters;
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        if (std::abs(weights[i]) > rounding)
          masters.emplace_back(face.nodes[i], weights[i]);
      return masters;
    }

    bool
    is_sharp(const std::vector<FaceNet::Closest> &feature)
    {
      std::vector<Tensor<1, 3>> normals;
      for (const FaceNet::Closest &at : feature)
        normals.push_back(at.normal);
      return bodies::smooth_patches(normals).size() > 1;
    }
  } // namespace

  MasterSurface::MasterSurface(const bodies::Structure   &body,
                               const bodies::BoundaryIds &ids)
    : faces(body, body.surface(ids))
    , feet(faces)
  {
    for (const FaceNet::Face &face : faces.all())
      typical_size += face.size / static_cast<double>(faces.all().size());
    if (const bodies::Surface boundary = whole_boundary(body);
        !boundary.two_sided)
      whole = std::make_unique<FaceNet>(body, boundary);
  }

  /**
   * The arm from the foot to p, without what a node overhangs the rim; none if
   * that is too much and the node stands beside the surface. Facets of a curved
   * surface end at an angle to it: what they miss by that is no overhang.
   */
  std::optional<Tensor<1, 3>>
  MasterSurface::arm_over(const Feature &feature, const Tensor<1, 3> &arm) const
  {
    Tensor<1, 3> over = arm;
    for (const FaceNet::Closest &at : feature)
      for (const std::size_t e : faces.edges_at(at))
        {
          const FaceNet::Face &face    = faces.all()[at.face];
          const Tensor<1, 3>  &outward = face.edges[e].outward;
          if (!face.edges[e].is_rim())
            continue;
          if (outward * arm >
              overhang * face.size + 1.001 * face.bend * arm.norm())
            return {};
          if (outward * over > 0)
            over -= (outward * over) * outward;
        }
    return over;
  }

  /** Meets a face that p is over, or a little beyond the sharp edge of. */
  std::optional<MasterSurface::Meeting>
  MasterSurface::meet_face(const Feature                   &feature,
                           const Tensor<1, 3>              &arm,
                           const std::vector<Tensor<1, 3>> &slave_normals,
                           const Limits                    &limits) const
  {
    // Beside a sharp edge a node that overhangs by next to nothing is still
    // over the face; beside a smooth one it meets the edge unless it is
    // straight above the face. On a face alone there is nothing else to meet.
    const double           allowed = feature.size() == 1 ? 1 :
                                     is_sharp(feature)   ? overhang :
                                                           round_off;
    std::optional<Meeting> best;
    double                 nearest = 0;
    for (const FaceNet::Closest &at : feature)
      {
        const double gap  = arm * at.normal;
        const double miss = (arm - gap * at.normal).norm();
        if (miss <= allowed * faces.all()[at.face].size &&
            largest_cosine(at.normal, slave_normals) >= limits.cosine &&
            (!best || miss < nearest))
          {
            best    = Meeting{gap, at.normal};
            nearest = miss;
          }
      }
    return best;
  }

  /** Meets an edge or vertex of the surface. */
  std::optional<MasterSurface::Meeting>
  MasterSurface::meet_edge(const Feature                   &feature,
                           const Tensor<1, 3>              &arm,
                           const std::vector<Tensor<1, 3>> &slave_normals,
                           const Limits                    &limits) const
  {
    const double distance = arm.norm();
    // Where the node touches, its direction from the edge is rounding: of the
    // cone that normals around the edge span, the one is taken that opposes the
    // slave most.
    if (distance <= touching * faces.all()[feature[0].face].size)
      {
        std::vector<Tensor<1, 3>> cone;
        for (const FaceNet::Closest &at : feature)
          cone.push_back(at.normal);
        Tensor<1, 3> best;
        for (const Tensor<1, 3> &n : slave_normals)
          if (const Tensor<1, 3> nearest = nearest_in_cone(-n, cone);
              nearest.norm() > best.norm() + round_off)
            best = nearest;
        if (best.norm() < limits.cosine || best.norm() == 0)
          return {};
        best /= best.norm();
        return Meeting{arm * best, best};
      }
    const double       side = arm * faces.sum_of_normals(feature) < 0 ? -1 : 1;
    const Tensor<1, 3> normal = side / distance * arm;
    const bool         meets =
      is_sharp(feature) ?
                nearest_in_cone(-normal, slave_normals).norm() >= cosine_to_edge :
                largest_cosine(normal, slave_normals) >= limits.cosine;
    if (!meets)
      return {};
    return Meeting{side * distance, normal};
  }

  /* A face, or an edge or corner where faces meet: what opposes the slave more
     is met. Where the node touches an edge, its direction from the foot is
     rounding, and the cone of normals there decides. */
  std::optional<MasterSurface::Meeting>
  MasterSurface::meet(Feature                          feature,
                      const Point<3>                  &p,
                      const std::vector<Tensor<1, 3>> &slave_normals,
                      const Limits                    &limits) const
  {
    if (feature.empty())
      return {};
    if (!whole)
      for (FaceNet::Closest &at : feature)
        {
          const auto        &corners = faces.all()[at.face].corners;
          const Tensor<1, 3> towards = p - at.point;
          if (corners.size() == 2 && !is_plane(corners, slave_normals, towards))
            turn_around_line(corners, slave_normals, towards, at.normal);
          turn_against(slave_normals, towards, at.normal);
        }
    const auto arm = arm_over(feature, p - feature[0].point);
    if (!arm)
      return {};
    const auto over = meet_face(feature, *arm, slave_normals, limits);
    if (feature.size() == 1)
      return over;
    const auto edge   = meet_edge(feature, *arm, slave_normals, limits);
    const auto cosine = [&](const std::optional<Meeting> &meeting) {
      return meeting ? nearest_in_cone(-meeting->normal, slave_normals).norm() :
                       -1.;
    };
    const bool touches =
      arm->norm() <= touching * faces.all()[feature[0].face].size;
    return touches || cosine(edge) > cosine(over) + round_off ? edge : over;
  }

  /* Whether a foot behind its face is an interference, and not the far side of
     the body: any foot in front of its face is allowed. */
  bool
  MasterSurface::may_be_behind(const Point<3>      &p,
                               const double         gap,
                               const FaceNet::Face &face,
                               const double         size,
                               const Limits        &limits) const
  {
    if (gap >= -1e-6 * size - face.sagitta)
      return true;
    if (!whole)
      return gap >= -limits.interference;
    if (!limits.inside)
      return false;
    // Well inside the body any depth is an interference. Near its boundary, as
    // at the side of a block that another one is pressed into, the point may be
    // beside the body, and only as deep as interferences are.
    const double distance = whole->signed_distance(p);
    return distance < -overhang ||
           (distance <= overhang && gap >= -limits.interference);
  }

  std::optional<MasterSurface::Foot>
  MasterSurface::foot(const Point<3>                  &p,
                      const std::vector<Tensor<1, 3>> &slave_normals,
                      const Limits                    &limits) const
  {
    // Most feet are near, and the nearest foot of a ball is the nearest of all.
    // What has none in these balls, as nodes that look away, asks those faces
    // only whose normals are towards it.
    for (const double faces_away : {1., 4.})
      if (const double radius = faces_away * typical_size;
          radius < limits.reach)
        {
          Limits nearby = limits;
          nearby.reach  = radius;
          if (const auto found = nearest_foot(
                p, slave_normals, nearby, faces.places().near({p, radius})))
            return found;
        }
    return nearest_foot(p,
                        slave_normals,
                        limits,
                        feet.faces_with_foot(faces, p));
  }

  /* Meets a bent face where it is: at the point from which p lies along the
     face's own normal. At its sharp edge there is no such point near the foot
     on chords, and what is met there stays. */
  MasterSurface::Foot
  MasterSurface::foot_on(const FaceNet::Face         &face,
                         const Point<3>              &p,
                         const Meeting               &meeting,
                         const std::array<double, 2> &at) const
  {
    constexpr double same_side = .8; // as a cosine
    if (!face.middles.empty())
      if (auto bent = foot_on_bent(face, p, at))
        {
          if (bent->normal * meeting.normal > same_side)
            return {(p - bent->point) * bent->normal,
                    bent->normal,
                    face.size,
                    masters_at(face, bent->at)};
        }
    return {meeting.gap,
            meeting.normal,
            face.size,
            masters_at(face, acting_at(face, p, meeting.normal, at))};
  }

  std::optional<MasterSurface::Foot>
  MasterSurface::nearest_foot(const Point<3>                  &p,
                              const std::vector<Tensor<1, 3>> &slave_normals,
                              const Limits                    &limits,
                              const std::vector<std::size_t>  &among) const
  {
    std::optional<Foot> best;
    double              nearest = limits.reach;
    double              opposes = -1;
    const auto         &all     = faces.all();
    for (const std::size_t f : among)
      {
        // Cheap tests first: what is further than the best foot so far, has no
        // perpendicular to p, or looks the way that the slave looks.
        if (all[f].centre.distance(p) - all[f].radius > nearest ||
            !all[f].may_have_foot(p) ||
            (whole && largest_cosine(all[f].outward, slave_normals) < -.5))
          continue;
        const FaceNet::Closest at = faces.project(f, p);
        if (at.distance > nearest)
          continue;
        const auto meeting =
          meet(faces.feature(at, p), p, slave_normals, limits);
        if (!meeting ||
            !may_be_behind(p, meeting->gap, all[f], all[f].size, limits))
          continue;
        const double cosine = largest_cosine(meeting->normal, slave_normals);
        // Feet that are as near, as on both faces of an edge, are told apart by
        // which of them opposes the slave more.
        if (at.distance == nearest && cosine <= opposes)
          continue;
        nearest = at.distance;
        opposes = cosine;
        best    = foot_on(all[f], p, *meeting, at.at);
      }
    return best;
  }
} // namespace conetact::pairing
