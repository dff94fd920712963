// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Surfaces without edges.

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/pairing/obstacle_entries.h"
#include "conetact/pairing/obstacle_shapes.h"

#include <cmath>
#include <limits>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    using Handler = dealii::ParameterHandler;
    using Shape   = std::unique_ptr<ObstacleShape>;

    /** A gap g(x, y, z) that is written down, along one normal. No shape stands
     * behind it, so it is asked at undeformed nodes only. */
    class PrescribedGap : public ObstacleShape
    {
    public:
      PrescribedGap(const Tensor<1, 3> &n, Expression g)
        : normal(n)
        , gap(std::move(g))
      {}
      Closest
      closest(const Point<3> &p, const double) const override
      {
        return {gap(p), normal};
      }
      /** A function of the undeformed node, not of a place. */
      double
      gap_after(const Point<3>     &X,
                const Tensor<1, 3> &u,
                const double) const override
      {
        // A gap changes by the motion along its normal: g(X) + n . u.
        return gap(X) + u * normal;
      }
      bool
      states_gaps() const override
      {
        return true;
      }
      static void
      declare(Handler &prm)
      {
        declare_normal(prm);
        prm.declare_entry("Gap",
                          "0",
                          dealii::Patterns::Anything(),
                          "prescribed gap: gap along the normal, a function "
                          "of x, y, z; negative: an interference. [length]");
      }
      static Shape
      create(Handler &prm, const unsigned int dim, const std::string &in)
      {
        return std::make_unique<PrescribedGap>(
          unit_vector(prm, "Normal", dim, in),
          Expression(prm.get("Gap"), in + "Gap"));
      }

    private:
      Tensor<1, 3> normal;
      Expression   gap;
    };

    /** The half space n . (x - x_0) <= 0; gaps are distances, however far. */
    class HalfSpace : public ObstacleShape
    {
    public:
      HalfSpace(const Point<3> &p, const Tensor<1, 3> &n)
        : origin(p)
        , normal(n)
      {}
      Closest
      closest(const Point<3> &p, const double) const override
      {
        return {(p - origin) * normal, normal};
      }
      static void
      declare(Handler &prm)
      {
        declare_normal(prm);
        declare_round(prm);
      }
      static Shape
      create(Handler &prm, const unsigned int dim, const std::string &in)
      {
        const Tensor<1, 3> n = unit_vector(prm, "Normal", dim, in);
        return std::make_unique<HalfSpace>(point(prm, "Point", dim, in), n);
      }

    private:
      Point<3>     origin;
      Tensor<1, 3> normal;
    };

    /**
     * The points at a distance `radius` from a centre, or from an axis through
     * it: the gap is |arm| - radius outside and radius - |arm| in a hole, with
     * the arm across the axis. There is no normal where the arm has no length.
     */
    class Round : public ObstacleShape
    {
    public:
      Round(const Point<3>     &c,
            const Tensor<1, 3> &a,
            const double        r,
            const bool          in,
            const std::string  &where)
        : centre(c)
        , axis(a)
        , radius(r)
        , inside(in)
        , entry(where)
      {}
      Closest
      closest(const Point<3> &p, const double spacing) const override
      {
        if (const auto found = closest_if_any(p, spacing))
          return *found;
        throw InputError(entry + ": a contact node stands at its centre, " +
                         to_text(p) +
                         ", where no point of the surface is "
                         "the closest. Move the obstacle or the body.");
      }
      std::optional<Closest>
      closest_if_any(const Point<3> &p, const double) const override
      {
        Tensor<1, 3> arm = p - centre;
        arm -= (arm * axis) * axis;
        const double distance = arm.norm();
        if (distance <= 1e-12 * radius)
          return {};
        const double side = inside ? -1 : 1;
        // In a hole the body is inside: gap and normal change their sign.
        return Closest{side * (distance - radius), side / distance * arm};
      }
      /** Also at the centre, where there is a gap but no normal. */
      double
      gap_after(const Point<3>     &X,
                const Tensor<1, 3> &u,
                const double) const override
      {
        Tensor<1, 3> arm = X + u - centre;
        arm -= (arm * axis) * axis;
        return inside ? radius - arm.norm() : arm.norm() - radius;
      }
      static void
      declare(Handler &prm)
      {
        declare_round(prm);
        prm.declare_entry("Side",
                          "outside",
                          dealii::Patterns::Selection("outside|inside"),
                          "sphere, cylinder: where the body is.");
      }
      static Shape
      create_sphere(Handler &prm, const unsigned int dim, const std::string &in)
      {
        return std::make_unique<Round>(point(prm, "Center", dim, in),
                                       Tensor<1, 3>(),
                                       positive(prm, "Radius", in),
                                       prm.get("Side") == "inside",
                                       in + "Center");
      }
      static Shape
      create_cylinder(Handler           &prm,
                      const unsigned int dim,
                      const std::string &in)
      {
        return std::make_unique<Round>(point(prm, "Point", dim, in),
                                       unit_vector(prm, "Axis", 3, in),
                                       positive(prm, "Radius", in),
                                       prm.get("Side") == "inside",
                                       in + "Point");
      }

    private:
      Point<3>     centre;
      Tensor<1, 3> axis; ///< zero: a sphere
      double       radius;
      bool         inside;
      std::string  entry;
    };

    /**
     * Surface phi = 0, phi > 0 outside: gap phi/|grad phi|, normal
     * grad phi/|grad phi|; differences of fourth order stand for the gradient.
     */
    class Implicit : public ObstacleShape
    {
    public:
      Implicit(Expression expression, const unsigned int d, std::string in)
        : phi(std::move(expression))
        , dim(d)
        , entry(std::move(in))
      {}
      Closest
      closest(const Point<3> &p, const double spacing) const override
      {
        if (const auto found = closest_if_any(p, spacing))
          return *found;
        throw InputError(entry + ": the gradient vanishes at the contact " +
                         "node " + to_text(p) +
                         ". Give a function whose "
                         "gradient is not zero near its surface.");
      }
      std::optional<Closest>
      closest_if_any(const Point<3> &p, const double spacing) const override
      {
        // Steps are small beside a cell, on which the surface is taken for
        // smooth.
        const Tensor<1, 3> gradient = gradient_at(p, .02 * spacing);
        const double       norm     = gradient.norm();
        if (norm == 0 || !std::isfinite(norm))
          return {};
        // The distance to first order: exact on the surface, and enough near
        // it.
        return Closest{phi(p) / norm, gradient / norm};
      }
      /** Without gradient a node is far from the surface, or deep in it. */
      double
      gap_after(const Point<3>     &X,
                const Tensor<1, 3> &u,
                const double        spacing) const override
      {
        const double value = phi(X + u);
        const double norm  = gradient_at(X + u, .02 * spacing).norm();
        return norm > 0 && std::isfinite(norm) ?
                 value / norm :
                 std::copysign(std::numeric_limits<double>::max(), value);
      }
      static void
      declare(Handler &prm)
      {
        prm.declare_entry("Function",
                          "",
                          dealii::Patterns::Anything(),
                          "implicit: phi(x, y, z), zero on the surface and "
                          "positive outside the obstacle, in any unit.");
      }
      static Shape
      create(Handler &prm, const unsigned int dim, const std::string &in)
      {
        return std::make_unique<Implicit>(Expression(prm.get("Function"),
                                                     in + "Function"),
                                          dim,
                                          in + "Function");
      }

    private:
      Tensor<1, 3>
      gradient_at(const Point<3> &p, const double h) const
      {
        Tensor<1, 3> gradient;
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d] =
            // The error is of the order h^4; rounding is that of phi over h.
            (8 * difference(p, d, h) - difference(p, d, 2 * h)) / (12 * h);
        return gradient;
      }
      double
      difference(const Point<3> &p, const unsigned int d, const double h) const
      {
        Point<3> right = p, left = p;
        right[d] += h;
        left[d] -= h;
        return phi(right) - phi(left);
      }
      Expression   phi;
      unsigned int dim;
      std::string  entry;
    };
  } // namespace

  ObstacleRow
  half_space_row()
  {
    return {"half space",
            "all points behind a plane (Point, Normal)",
            HalfSpace::declare,
            HalfSpace::create,
            {"Point", "Normal"}};
  }

  ObstacleRow
  prescribed_gap_row()
  {
    return {
      "prescribed gap",
      "a normal and the gap along it as a function of position (Normal, Gap)",
      PrescribedGap::declare,
      PrescribedGap::create,
      {"Normal", "Gap"}};
  }

  ObstacleRow
  sphere_row()
  {
    return {"sphere",
            "a ball, in 2D a disk, or the hole in it (Center, Radius, Side)",
            Round::declare,
            Round::create_sphere,
            {"Center", "Radius", "Side"}};
  }

  ObstacleRow
  cylinder_row()
  {
    return {"cylinder",
            "an infinite cylinder or bore (Point, Axis, Radius, Side)",
            Round::declare,
            Round::create_cylinder,
            {"Point", "Axis", "Radius", "Side"}};
  }

  ObstacleRow
  implicit_row()
  {
    return {"implicit",
            "where an expression is negative (Function)",
            Implicit::declare,
            Implicit::create,
            {"Function"}};
  }
} // namespace conetact::pairing
