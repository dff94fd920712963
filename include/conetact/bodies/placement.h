// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_placement_h
#define conetact_bodies_placement_h

#include "conetact/base/expression.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace conetact::bodies
{
  /**
   * Where a body stands in the scene: as generated or read, it is scaled,
   * then rotated, then moved, @f$x \mapsto R (s\,x) + d@f$ [length].
   */
  struct Placement
  {
    double               scale = 1;
    dealii::Tensor<2, 3> rotation; ///< orthogonal matrix
    dealii::Tensor<1, 3> translation;

    dealii::Point<3>
    to_scene(const dealii::Point<3> &p) const
    {
      return dealii::Point<3>(rotation * (scale * p) + translation);
    }
  };

  /** An axis of any length; exact at multiples of a right angle. */
  dealii::Tensor<2, 3>
  rotation_about(const dealii::Tensor<1, 3> &axis, const double degrees);

  /**
   * An angle about z, or in 3D an axis and an angle, 'x, y, z, angle', in
   * degrees. Throws InputError.
   */
  dealii::Tensor<2, 3>
  parse_rotation(const std::string &text,
                 const unsigned int dim,
                 const std::string &entry);

  /** What satisfies the condition (scene's coordinates) gets the id. */
  struct BoundaryTag
  {
    unsigned int id;
    std::string  text;
    Expression   condition;
  };

  /** Entries Scale, Rotation and Translation. */
  void
  declare_placement(dealii::ParameterHandler &prm);
  /** `where` is for messages: "Body 'block', Mesh/". Throws InputError. */
  Placement
  parse_placement(dealii::ParameterHandler &prm,
                  const unsigned int        dim,
                  const std::string        &where);

  /** 'id: condition ; ...'. Throws InputError that names the entry. */
  std::vector<BoundaryTag>
  parse_tags(const std::string &text, const std::string &entry);
} // namespace conetact::bodies

#endif
