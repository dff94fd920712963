// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_obstacles_h
#define conetact_pairing_obstacles_h

#include "conetact/base/expression.h"
#include "conetact/base/points.h"
#include "conetact/pairing/rigid_motion.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace conetact::pairing
{
  /**
   * Shape of a rigid obstacle: gap @f$g_0@f$ (positive: apart) and unit normal
   * @f$n@f$ from the obstacle to the body, from the closest point of its
   * surface. Contact is linearised at the undeformed node.
   */
  class ObstacleShape
  {
  public:
    struct Closest
    {
      double       gap; ///< [length]
      Tensor<1, 3> normal;
    };
    virtual ~ObstacleShape() = default;
    /**
     * `spacing`: distance of neighbouring nodes, the scale on which a shape
     * given by an expression may be differentiated. Throws InputError where
     * the closest point is not unique or the normal undefined.
     */
    virtual Closest
    closest(const Point<3> &p, const double spacing) const = 0;
    /** The same; nothing where closest() would throw. To be overridden by
     * shapes of which there are such places. */
    virtual std::optional<Closest>
    closest_if_any(const Point<3> &p, const double spacing) const
    {
      return closest(p, spacing);
    }

    /**
     * The gap of a node that stood at X and moved by u in the obstacle's own
     * frame [length]: that of the shape where the node is now.
     */
    virtual double
    gap_after(const Point<3>     &X,
              const Tensor<1, 3> &u,
              const double        spacing) const
    {
      return closest(X + u, spacing).gap;
    }
    /** Whether a negative gap is what the user wrote down. */
    virtual bool
    states_gaps() const
    {
      return false;
    }
    /** What a node meets that stood at X and moved by u in the obstacle's own
     * frame; nothing where there is no normal. Gaps that are stated are those
     * of the undeformed node. */
    std::optional<Closest>
    closest_after(const Point<3>     &X,
                  const Tensor<1, 3> &u,
                  const double        spacing) const
    {
      if (states_gaps())
        return Closest{gap_after(X, u, spacing), closest(X, spacing).normal};
      return closest_if_any(X + u, spacing);
    }
  };

  /**
   * What is free of an obstacle that loads press: components x, y, z of its
   * translation and rx, ry, rz of its rotation; the others follow what is
   * prescribed.
   */
  struct FreeMotion
  {
    std::array<bool, 6>     components{};
    std::vector<Expression> force;  ///< of t [force]; empty: none
    std::vector<Expression> moment; ///< of t, about the reference point
    bool
    any() const
    {
      return std::find(components.begin(), components.end(), true) !=
             components.end();
    }
  };

  /**
   * A rigid obstacle: a shape, and how it moves. It translates by d(t) and
   * turns about a reference point, or is free and found by the balance of its
   * forces.
   */
  struct Obstacle
  {
    std::string                    name;
    std::unique_ptr<ObstacleShape> shape;
    std::vector<Expression>        displacement; ///< [length], functions of t
    Point<3>                       reference;
    Tensor<1, 3>                   turn_axis; ///< unit
    std::optional<Expression>      turn;      ///< angle, of t [degrees]
    FreeMotion                     free;

    /** What its entry Displacement says. */
    Tensor<1, 3>
    displacement_at(const double t) const;
    /** All that is prescribed; nothing of one that is free. */
    RigidMotion
    motion_at(const double t) const;
  };

  /** One row for each shape. */
  struct ObstacleRow
  {
    const char *name;
    const char *description;
    void (*declare)(dealii::ParameterHandler &);
    std::unique_ptr<ObstacleShape> (*create)(dealii::ParameterHandler &,
                                             const unsigned int dim,
                                             const std::string &in);
    std::vector<std::string> entries = {}; ///< that it reads
  };
} // namespace conetact::pairing

#endif
