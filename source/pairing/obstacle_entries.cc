// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/obstacle_entries.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

namespace conetact::pairing
{
  using Handler = dealii::ParameterHandler;

  void
  declare_normal(Handler &prm)
  {
    prm.declare_entry("Normal",
                      "",
                      dealii::Patterns::Anything(),
                      "half space, prescribed gap: direction from the obstacle "
                      "to the body, of any length, n in [K].");
  }

  void
  declare_round(Handler &prm)
  {
    const auto declare =
      [&](const char *key, const char *value, const char *text) {
        prm.declare_entry(key, value, dealii::Patterns::Anything(), text);
      };
    declare("Center",
            "",
            "sphere, box: its centre. Empty: the origin. [length]");
    declare("Point",
            "",
            "half space: a point of its surface; cylinder: a point of its "
            "axis; cone: its apex. Empty: the origin. [length]");
    declare("Radius", "1", "sphere, cylinder: radius. [length]");
    declare("Axis",
            "0, 0, 1",
            "cylinder: direction of its axis, three components; cone: from "
            "its apex into it, as many components as the scene.");
  }

  void
  declare_shape_placement(Handler &prm)
  {
    const auto declare =
      [&](const char *key, const char *value, const char *text) {
        prm.declare_entry(key, value, dealii::Patterns::Anything(), text);
      };
    declare("Scale",
            "1",
            "surface mesh: factor on all coordinates, above 0. It is scaled, "
            "then rotated, then moved. [-]");
    declare("Rotation",
            "0",
            "box: about its centre; surface mesh: about the origin; "
            "counter-clockwise: an angle about z, or in 3D an axis and an "
            "angle, 'x, y, z, angle'. [degrees]");
    declare("Translation",
            "0",
            "surface mesh: where the origin moves, 'x, y' (2D) or 'x, y, z' "
            "(3D); 0 for nowhere. [length]");
  }

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
    return prm.get(key).empty() ?
             Point<3>() :
             Point<3>(to_vector(prm.get(key), dim, in + key));
  }

  double
  positive(Handler &prm, const std::string &key, const std::string &in)
  {
    const double number = to_number(prm.get(key), in + key);
    if (number <= 0)
      throw InputError(in + key + ": " + prm.get(key) +
                       " is not positive. Give a number above 0.");
    return number;
  }
} // namespace conetact::pairing
