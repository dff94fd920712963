// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_structures_actions_h
#define conetact_structures_actions_h

#include "conetact/base/expression.h"
#include "conetact/structures/structure.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace conetact
{
  /**
   * What holds a body on some of its boundary: displacements prescribed along
   * given directions, or springs per area along them (a foundation) whose far
   * ends move as prescribed.
   */
  struct Support
  {
    std::string  name;
    unsigned int body = 0; ///< index
    BoundaryIds  ids;
    bool         normal = false; ///< one direction: the node's own normal
    std::vector<Tensor<1, 3>> directions;   ///< unit length; unless `normal`
    std::vector<Expression>   displacement; ///< [length], one a direction
    std::optional<Expression> stiffness;    ///< [force/length/area]: elastic

    /** Directions at a node with this outward normal. */
    std::vector<Tensor<1, 3>>
    directions_at(const Tensor<1, 3> &outward_normal) const;

    /** Springs' stiffness per area at a point, a symmetric tensor. */
    Tensor<2, 3>
    spring(const Point<3> &p, const Tensor<1, 3> &outward_normal) const;
  };

  /** Forces on a body, a function of position and time. */
  struct Load
  {
    enum class Kind
    {
      traction,   ///< [force/area] on boundary ids
      pressure,   ///< [force/area] against the outward normal
      body_force, ///< [force/volume]
      point_force ///< [force] at a point of the body
    };
    std::string             name;
    unsigned int            body = 0; ///< index
    Kind                    kind = Kind::traction;
    BoundaryIds             ids;   ///< traction, pressure
    Point<3>                point; ///< point force
    std::vector<Expression> value; ///< a component each; pressure: one

    /** Adds the nodal forces at time t. */
    void
    add(const Structure &structure, const double t, Eigen::VectorXd &f) const;
  };

  /**
   * Entries of `subsection Support NAME` and `subsection Load NAME`. The
   * handler stands inside the subsection.
   */
  void
  declare_support(dealii::ParameterHandler &prm);
  void
  declare_load(dealii::ParameterHandler &prm);

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
  Load
  create_load(dealii::ParameterHandler             &prm,
              const std::string                    &name,
              const unsigned int                    dim,
              const std::vector<std::string>       &bodies,
              const std::vector<const Structure *> &structures);

  /** Index of a body by name. Throws InputError that names the entry. */
  unsigned int
  find_body(const std::string              &body,
            const std::vector<std::string> &bodies,
            const std::string              &entry);

  /** The ids of an entry; each one must be a face's. Throws InputError. */
  BoundaryIds
  find_boundary(const std::string &ids,
                const Structure   &structure,
                const std::string &body,
                const std::string &entry);
} // namespace conetact

#endif
