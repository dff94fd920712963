// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Solids with an apex, edges and corners: there a body may lie against any
// direction between the faces, and the one to the node is taken.

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/placement.h"
#include "conetact/pairing/obstacle_entries.h"
#include "conetact/pairing/obstacle_shapes.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    using Handler = dealii::ParameterHandler;
    using Shape   = std::unique_ptr<ObstacleShape>;

    /**
     * A point nearer to a feature than this part of the coordinates is on it.
     */
    constexpr double on_feature = 1e-12;

    /**
     * All points within the half angle alpha of an axis that begins at an apex,
     * in the plane a wedge; the apex is sharp, or rounded by a ball of radius
     * rho that touches the sides: its centre is rho / sin(alpha) along the
     * axis, and it touches rho cot(alpha) along a side. With z along the axis
     * and r across it the side r cos(alpha) = z sin(alpha) has the normal
     * cos(alpha) e_r - sin(alpha) e_z.
     */
    class Cone : public ObstacleShape
    {
    public:
      Cone(const Point<3>     &a,
           const Tensor<1, 3> &direction,
           const double        half_angle,
           const double        radius)
        : apex(a)
        , axis(direction)
        , sine(std::sin(half_angle))
        , cosine(std::cos(half_angle))
        , round(radius)
        , centre(apex + radius / sine * axis)
      {}
      Closest
      closest(const Point<3> &p, const double) const override
      {
        // All that matters of a point is how far along the axis it is, z, and
        // how far from it, r.
        const double       z      = (p - apex) * axis;
        const Tensor<1, 3> across = (p - apex) - z * axis;
        const double       r      = across.norm();
        // The foot on the side is r sin(alpha) + z cos(alpha) from the apex
        // along it. Where that is not beyond the point in which ball and side
        // touch, the ball is nearest, or the sharp apex.
        if (r * sine + z * cosine <= round * cosine / sine)
          return from_centre(p);
        if (r <= on_feature * (p - apex).norm())
          // On the axis every line of the side is as near, and none is the
          // closest: the way goes back out through the apex.
          return {(apex - p) * axis + round / sine - round, -axis};
        return {r * cosine - z * sine, cosine / r * across - sine * axis};
      }
      static void
      declare(Handler &prm)
      {
        declare_round(prm);
        prm.declare_entry("Half angle",
                          "45",
                          dealii::Patterns::Anything(),
                          "cone: between its axis and its side, more than 0 "
                          "and less than 90. [degrees]");
        prm.declare_entry("Apex radius",
                          "0",
                          dealii::Patterns::Anything(),
                          "cone: radius of the ball that rounds its apex and "
                          "touches its side; Point is where the side alone "
                          "would end. 0: the apex is sharp, and the direction "
                          "to the node is the normal there. [length]");
      }
      static Shape
      create(Handler &prm, const unsigned int dim, const std::string &in)
      {
        const double degrees =
          to_number(prm.get("Half angle"), in + "Half angle");
        if (degrees <= 0 || degrees >= 90)
          throw InputError(in + "Half angle: " + prm.get("Half angle") +
                           " is no angle of a cone. Give one between 0 and 90 "
                           "degrees.");
        const double radius =
          to_number(prm.get("Apex radius"), in + "Apex radius");
        if (radius < 0)
          throw InputError(in + "Apex radius: " + prm.get("Apex radius") +
                           " is negative. Give 0 for a sharp apex, or a "
                           "radius.");
        return std::make_unique<Cone>(point(prm, "Point", dim, in),
                                      unit_vector(prm, "Axis", dim, in),
                                      degrees * M_PI / 180,
                                      radius);
      }

    private:
      Closest
      from_centre(const Point<3> &p) const
      {
        const Tensor<1, 3> arm      = p - centre;
        const double       distance = arm.norm();
        // At the centre of the ball, or at a sharp apex, all its normals meet.
        if (distance <= on_feature * (round + p.norm()))
          return {-round, -axis};
        return {distance - round, arm / distance};
      }

      Point<3>     apex;
      Tensor<1, 3> axis; ///< into the cone
      double       sine, cosine;
      double       round;
      Point<3>     centre; ///< of the ball at the apex
    };



    /** A box, in the plane a rectangle, seen from outside. */
    class Box : public ObstacleShape
    {
    public:
      Box(const Point<3>     &c,
          const Tensor<1, 3> &sizes,
          const Tensor<2, 3> &turned,
          const unsigned int  d)
        : centre(c)
        , half(.5 * sizes)
        , rotation(turned)
        , dim(d)
      {}
      Closest
      closest(const Point<3> &p, const double) const override
      {
        // The signed distance of a box is |max(b, 0)| outside and the largest
        // component of b inside, with b = |q| - half, `beyond`, in its own
        // axes.
        const Tensor<1, 3> q = transpose(rotation) * (p - centre);
        const double on = on_feature * (half.norm() + centre.norm() + p.norm());
        Tensor<1, 3> beyond, outside;
        unsigned int nearest = 0;
        for (unsigned int d = 0; d < dim; ++d)
          {
            beyond[d]  = std::abs(q[d]) - half[d];
            outside[d] = std::copysign(std::max(beyond[d], 0.), q[d]);
            if (beyond[d] > beyond[nearest])
              nearest = d;
          }
        if (outside.norm() > on)
          return {outside.norm(), rotation * (outside / outside.norm())};
        // Inside one face is the nearest; on an edge its faces count alike.
        Tensor<1, 3> facing;
        for (unsigned int d = 0; d < dim; ++d)
          if (d == nearest || beyond[d] >= -on)
            facing[d] = std::copysign(1., q[d]);
        return {std::min(beyond[nearest], 0.),
                rotation * (facing / facing.norm())};
      }
      static void
      declare(Handler &prm)
      {
        declare_round(prm);
        prm.declare_entry("Sizes",
                          "",
                          dealii::Patterns::Anything(),
                          "box: lengths of its edges along x, y and z. "
                          "[length]");
        declare_shape_placement(prm);
      }
      static Shape
      create(Handler &prm, const unsigned int dim, const std::string &in)
      {
        const Tensor<1, 3> sizes =
          to_vector(prm.get("Sizes"), dim, in + "Sizes");
        for (unsigned int d = 0; d < dim; ++d)
          if (sizes[d] <= 0)
            throw InputError(in + "Sizes: '" + prm.get("Sizes") +
                             "' has one that is not positive. Give lengths "
                             "above 0.");
        return std::make_unique<Box>(point(prm, "Center", dim, in),
                                     sizes,
                                     bodies::parse_rotation(trim(prm.get(
                                                              "Rotation")),
                                                            dim,
                                                            in + "Rotation"),
                                     dim);
      }

    private:
      Point<3>     centre;
      Tensor<1, 3> half; ///< edges
      Tensor<2, 3> rotation;
      unsigned int dim;
    };
  } // namespace

  ObstacleRow
  cone_row()
  {
    return {"cone",
            "an infinite cone, in 2D a wedge (Point, Axis, Half angle, Apex "
            "radius)",
            Cone::declare,
            Cone::create,
            {"Point", "Axis", "Half angle", "Apex radius"}};
  }

  ObstacleRow
  box_row()
  {
    return {"box",
            "a box, in 2D a rectangle (Center, Sizes, Rotation)",
            Box::declare,
            Box::create,
            {"Center", "Sizes", "Rotation"}};
  }
} // namespace conetact::pairing
