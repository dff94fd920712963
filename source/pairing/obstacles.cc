// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/obstacles.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <cmath>
#include <limits>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    using Handler = dealii::ParameterHandler;
    using Shape   = std::unique_ptr<ObstacleShape>;

    Tensor<1, 3>
    unit_vector(Handler           &prm,
                const std::string &key,
                const unsigned int dim,
                const std::string &in)
    {
      const Tensor<1, 3> v = to_vector(prm.get(key), dim, in + key);
      if (v.norm() == 0)
        throw InputError(in + key + ": the vector " + prm.get(key) +
                         " has no length. Give a direction other than zero.");
      return v / v.norm();
    }

    Point<3>
    point(Handler           &prm,
          const std::string &key,
          const unsigned int dim,
          const std::string &in)
    {
      return Point<3>(to_vector(prm.get(key), dim, in + key));
    }

    void
    declare_vector(Handler           &prm,
                   const std::string &key,
                   const std::string &value,
                   const std::string &text)
    {
      prm.declare_entry(key, value, dealii::Patterns::Anything(), text);
    }

    void
    declare_normal(Handler &prm)
    {
      declare_vector(prm,
                     "Normal",
                     "",
                     "half space, prescribed gap: direction from the obstacle "
                     "to the body, of any length, n in [K].");
    }



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
        // it changes by the motion along its normal
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
        declare_vector(prm,
                       "Point",
                       "",
                       "half space: a point of its surface; cylinder: a point "
                       "of its axis. Empty: the origin. [length]");
      }
      static Shape
      create(Handler &prm, const unsigned int dim, const std::string &in)
      {
        const Tensor<1, 3> n = unit_vector(prm, "Normal", dim, in);
        return std::make_unique<HalfSpace>(prm.get("Point").empty() ?
                                             Point<3>() :
                                             point(prm, "Point", dim, in),
                                           n);
      }

    private:
      Point<3>     origin;
      Tensor<1, 3> normal;
    };

    /**
     * Points at a distance `radius` from a centre, or from an axis through it.
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
      closest(const Point<3> &p, const double) const override
      {
        Tensor<1, 3> arm = p - centre;
        arm -= (arm * axis) * axis;
        const double distance = arm.norm();
        if (distance <= 1e-12 * radius)
          throw InputError(entry + ": a contact node stands at its centre, " +
                           to_text(p) +
                           ", where no point of the surface is "
                           "the closest. Move the obstacle or the body.");
        const double side = inside ? -1 : 1;
        // In a hole the body is inside: gap and normal change their sign.
        return {side * (distance - radius), side / distance * arm};
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
        declare_vector(prm,
                       "Center",
                       "",
                       "sphere: its centre. Empty: the origin. [length]");
        prm.declare_entry("Radius",
                          "1",
                          dealii::Patterns::Anything(),
                          "sphere, cylinder: radius. [length]");
        prm.declare_entry("Side",
                          "outside",
                          dealii::Patterns::Selection("outside|inside"),
                          "sphere, cylinder: where the body is.");
      }
      static void
      declare_axis(Handler &prm)
      {
        declare(prm);
        declare_vector(prm,
                       "Axis",
                       "0, 0, 1",
                       "cylinder: direction of its axis, three components.");
      }
      static double
      get_radius(Handler &prm, const std::string &in)
      {
        const double radius = to_number(prm.get("Radius"), in + "Radius");
        if (radius <= 0)
          throw InputError(in + "Radius: " + prm.get("Radius") +
                           " is not positive. Give a radius above 0.");
        return radius;
      }
      static Shape
      create_sphere(Handler &prm, const unsigned int dim, const std::string &in)
      {
        return std::make_unique<Round>(prm.get("Center").empty() ?
                                         Point<3>() :
                                         point(prm, "Center", dim, in),
                                       Tensor<1, 3>(),
                                       get_radius(prm, in),
                                       prm.get("Side") == "inside",
                                       in + "Center");
      }
      static Shape
      create_cylinder(Handler           &prm,
                      const unsigned int dim,
                      const std::string &in)
      {
        return std::make_unique<Round>(prm.get("Point").empty() ?
                                         Point<3>() :
                                         point(prm, "Point", dim, in),
                                       unit_vector(prm, "Axis", 3, in),
                                       get_radius(prm, in),
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
        // Steps small beside a cell, on which the surface is taken for smooth.
        const Tensor<1, 3> gradient = gradient_at(p, .02 * spacing);
        const double       norm     = gradient.norm();
        if (norm == 0 || !std::isfinite(norm))
          throw InputError(entry + ": the gradient vanishes at the contact " +
                           "node " + to_text(p) +
                           ". Give a function whose "
                           "gradient is not zero near its surface.");
        // The distance to first order: exact on the surface, and enough near
        // it.
        return {phi(p) / norm, gradient / norm};
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

  const std::vector<ObstacleRow> &
  obstacle_table()
  {
    static const std::vector<ObstacleRow> table = {
      {"half space",
       "all points behind a plane (Point, Normal)",
       HalfSpace::declare,
       HalfSpace::create},
      {"prescribed gap",
       "a normal and the gap along it as a function of position (Normal, Gap)",
       PrescribedGap::declare,
       PrescribedGap::create},
      {"sphere",
       "a ball, in 2D a disk, or the hole in it (Center, Radius, Side)",
       Round::declare,
       Round::create_sphere},
      {"cylinder",
       "an infinite cylinder or bore (Point, Axis, Radius, Side)",
       Round::declare_axis,
       Round::create_cylinder},
      {"implicit",
       "where an expression is negative (Function)",
       Implicit::declare,
       Implicit::create}};
    return table;
  }

  Tensor<1, 3>
  Obstacle::displacement_at(const double t) const
  {
    Tensor<1, 3> d;
    for (unsigned int c = 0; c < displacement.size(); ++c)
      // a translation: the same everywhere
      d[c] = displacement[c](Point<3>(), t);
    return d;
  }

  void
  declare_obstacle(dealii::ParameterHandler &prm)
  {
    std::vector<std::string> names, lines;
    for (const ObstacleRow &row : obstacle_table())
      {
        names.push_back(row.name);
        lines.push_back(std::string(row.name) + ": " + row.description);
      }
    prm.declare_entry("Shape",
                      names.front(),
                      dealii::Patterns::Selection(join(names, "|")),
                      join(lines, "; ") + ".");
    for (const ObstacleRow &row : obstacle_table())
      row.declare(prm);
    prm.declare_entry("Displacement",
                      "0",
                      dealii::Patterns::Anything(),
                      "Translation d(t) of the obstacle since the start, a "
                      "function of t each component, separated by ';'. A "
                      "single 0: it stands still. [length]");
  }

  Obstacle
  create_obstacle(dealii::ParameterHandler &prm,
                  const std::string        &name,
                  const unsigned int        dim)
  {
    const std::string in = "Obstacle '" + name + "', ";
    Obstacle          obstacle;
    obstacle.name = name;
    for (const ObstacleRow &row : obstacle_table())
      if (prm.get("Shape") == row.name)
        obstacle.shape = row.create(prm, dim, in);
    obstacle.displacement =
      parse_expressions(prm.get("Displacement"), in + "Displacement");
    for (const Expression &d : obstacle.displacement)
      if (d.uses_space())
        throw InputError(in + "Displacement: '" + prm.get("Displacement") +
                         "' depends on position. A rigid obstacle moves as a "
                         "whole: use t only.");
    const bool still =
      obstacle.displacement.size() == 1 && obstacle.displacement[0].is_zero();
    if (!still && obstacle.displacement.size() != dim)
      throw InputError(in + "Displacement: '" + prm.get("Displacement") +
                       "' has " + std::to_string(obstacle.displacement.size()) +
                       " expressions. Give " + std::to_string(dim) +
                       " functions of t, separated by ';', or a single 0.");
    return obstacle;
  }
} // namespace conetact::pairing
