// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_supports_h
#define conetact_bodies_supports_h

#include "conetact/base/expression.h"
#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /**
   * What holds a body on some of its boundary: displacements prescribed along
   * given directions, or springs per area along them (a foundation) whose far
   * ends move as prescribed; and rotations prescribed at nodes that rotate.
   */
  struct Support
  {
    std::string  name;
    unsigned int body = 0; ///< index
    BoundaryIds  ids;
    Surface      surface;        ///< of these ids
    bool         normal = false; ///< one direction: the node's own normal
    std::vector<Tensor<1, 3>> directions;   ///< unit length; unless `normal`
    std::vector<Expression>   displacement; ///< [length], one a direction
    std::optional<Expression> stiffness;    ///< [force/length/area]: elastic

    /** All that it holds turns about a point, the displacement comes after. */
    struct Turn
    {
      Expression   angle; ///< [degrees], of t
      Tensor<1, 3> axis;
      Point<3>     centre;
    };
    std::optional<Turn> turn;
    /** Displacement at p along the direction of an expression [length]. */
    double
    displaced(const std::size_t expression,
              const Point<3>   &p,
              const double      t) const;

    /** A rotation that is held at each node that has it as a dof. */
    struct Rotation
    {
      unsigned int component; ///< of the node's dofs
      Expression   angle;     ///< [rad]
    };
    std::vector<Rotation> rotations;

    /** A direction that is held, and which displacement belongs to it. */
    struct Held
    {
      Tensor<1, 3> direction;
      std::size_t  expression; ///< index
    };
    /**
     * Directions at a node: of its own normals, every one where an edge of
     * the body has several.
     */
    std::vector<Held>
    directions_at(const SurfaceNode &node) const;

    /** From here on it holds nothing. */
    void
    release();
    /** Whether it holds the body where it is at all times. */
    bool
    is_still() const;

    /** Springs' stiffness per area at a point, a symmetric tensor. */
    Tensor<2, 3>
    spring(const Point<3> &p, const Tensor<1, 3> &outward_normal) const;
  };

  /**
   * Holds the nodes of a body of revolution that lie on its axis, radially;
   * none if it has a hole. `body` is its index.
   */
  std::optional<Support>
  axis_support(const Structure   &structure,
               const unsigned int body,
               const std::string &body_name);

  /** Entries of `subsection Support NAME`; the handler stands inside it. */
  void
  declare_support(dealii::ParameterHandler &prm);
  /**
   * The parsed entries; `bodies` are the names and `structures` the bodies
   * that boundary ids and points are checked against. Throws InputError.
   */
  Support
  create_support(dealii::ParameterHandler             &prm,
                 const std::string                    &name,
                 const unsigned int                    dim,
                 const std::vector<std::string>       &bodies,
                 const std::vector<const Structure *> &structures);
} // namespace conetact::bodies

#endif
