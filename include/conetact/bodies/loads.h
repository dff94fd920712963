// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_loads_h
#define conetact_bodies_loads_h

#include "conetact/base/expression.h"
#include "conetact/bodies/spread_force.h"
#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace conetact::bodies
{
  /** Forces on a body, a function of position and time. */
  struct Load
  {
    enum class Kind
    {
      traction,      ///< [force/area] on boundary ids
      pressure,      ///< [force/area] against the outward normal
      body_force,    ///< [force/volume]
      centrifugal,   ///< angular velocity [rad/time] about a point and an axis
      point_force,   ///< [force] at a point of the body
      force,         ///< [force] in all, spread over boundary ids
      moment,        ///< [force x length] in all, the same
      bearing,       ///< [force] in all, as a pin presses on its bore
      nodal_force,   ///< [force] at each node of boundary ids, with moments
                     ///< where values follow
      line_load,     ///< [force/length] on members of boundary ids
      temperature,   ///< change of temperature [K], an initial strain
      initial_strain ///< [-], components along `axes`
    };
    std::string  name;
    unsigned int body = 0; ///< index
    Kind         kind = Kind::traction;
    BoundaryIds  ids;         ///< of kinds that have them
    Point<3>     point;       ///< point force; force: where it acts; of an axis
    Tensor<1, 3> axis;        ///< unit, of a centrifugal load
    double       density = 0; ///< of its body, for that and for a weight
                              ///< [mass/length^3]
    /** Of a force or a moment that is spread. */
    std::shared_ptr<const SpreadForce> spread;
    /** Whether the faces of its boundary ids move as one with its point: it
     * acts on a rigid body of theirs then, whose first node the point is. */
    bool is_rigid = false;
    /** Whether laws of contacts take the temperatures that it gives: then its
     * body need not expand. */
    bool                      warms_contacts = false;
    std::vector<Expression>   value;  ///< a component each, or one
    std::optional<Expression> active; ///< of t: 0 where it is not there
    /** Of initial strains: the axes of each component. */
    std::vector<std::pair<unsigned int, unsigned int>> axes;

    bool
    uses_time() const;
    /** Whether it is there at time t. */
    bool
    is_active(const double t) const
    {
      return !active || (*active)(Point<3>(), t) != 0;
    }
    /** Whether it strains its body: nodal forces that balance by themselves. */
    bool
    strains() const
    {
      return kind == Kind::temperature || kind == Kind::initial_strain;
    }
    /** Whether it turns with its body; the others keep their directions. */
    bool
    follows() const
    {
      return kind == Kind::pressure || strains();
    }
    /** Whether it is nothing at all. */
    bool
    is_zero() const;

    /** Whether it is a force or a moment of given size, spread over faces: it
     * keeps its size and its direction in space, however they turn. */
    bool
    is_total() const
    {
      return spread != nullptr && !is_rigid;
    }

    /** Adds the nodal forces at time t; those of a total in the axes of a body
     * that has turned by `turn`. */
    void
    add(const Structure    &structure,
        const double        t,
        Eigen::VectorXd    &f,
        const Tensor<2, 3> &turn = dealii::unit_symmetric_tensor<3>()) const;
    /**
     * The load at time t as write_graphics() takes it; none for nodal forces.
     * It refers to this object.
     */
    std::optional<Action>
    action(const double        t,
           const Tensor<2, 3> &turn = dealii::unit_symmetric_tensor<3>()) const;

  private:
    Tensor<1, 3>
    total(const double t, const Tensor<2, 3> &turn) const;
    Tensor<1, 3>
    spread_traction(const Point<3> &p, const Tensor<1, 3> &total) const;
    Tensor<1, 3>
    centrifugal_force(const Point<3> &p, const double t) const;
    InitialStrain
    initial_strain(const Point<3> &p, const double t) const;
  };

  /** The weight of a body of this density [mass/volume] under gravity
   * [length/time^2]. */
  Load
  weight_of(const unsigned int  body,
            const std::string  &name,
            const double        density,
            const Tensor<1, 3> &gravity,
            const unsigned int  dim);

  /** Entries of `subsection Load NAME`; the handler stands inside it. */
  void
  declare_load(dealii::ParameterHandler &prm);
  /**
   * The parsed entries; `bodies` are the names and `structures` the bodies
   * that boundary ids and points are checked against. Throws InputError.
   */
  Load
  create_load(dealii::ParameterHandler             &prm,
              const std::string                    &name,
              const unsigned int                    dim,
              const std::vector<std::string>       &bodies,
              const std::vector<const Structure *> &structures);
} // namespace conetact::bodies

#endif
