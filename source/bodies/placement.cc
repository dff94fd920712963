// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/placement.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace conetact::bodies
{
  using dealii::ParameterHandler;
  using dealii::Tensor;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /** Sine and cosine that are exact at multiples of a right angle. */
    std::pair<double, double>
    sine_cosine(const double degrees)
    {
      const double rest = std::remainder(degrees, 90.);
      double       s    = std::sin(rest * dealii::numbers::PI / 180);
      double       c    = std::cos(rest * dealii::numbers::PI / 180);
      const auto   quarters =
        std::lround(std::remainder(degrees - rest, 360.) / 90.);
      for (long i = 0; i < (quarters + 4) % 4; ++i)
        {
          std::swap(s, c);
          c = -c;
        }
      return {s, c};
    }

    Tensor<1, 3>
    parse_translation(const std::string &text,
                      const unsigned int dim,
                      const std::string &entry)
    {
      // so that the default, and 2D scenes lifted to 3D, need no care
      const std::vector<double> numbers = to_numbers(text, entry);
      if (std::all_of(numbers.begin(), numbers.end(), [](const double x) {
            return x == 0;
          }))
        return {};
      return to_vector(text, dim, entry);
    }

    double
    parse_scale(const std::string &text, const std::string &entry)
    {
      const double scale = to_number(text, entry);
      if (!(scale > 0))
        throw InputError(entry + ": " + to_text(scale) +
                         " is not positive. Give a factor above 0.");
      return scale;
    }
  } // namespace

  /* Rodrigues' formula. */
  Tensor<2, 3>
  rotation_about(const Tensor<1, 3> &axis, const double degrees)
  {
    Assert(axis.norm() > 0, dealii::ExcMessage("An axis has a length."));
    const auto   sc       = sine_cosine(degrees);
    const auto   n        = axis / axis.norm();
    Tensor<2, 3> rotation = (1 - sc.second) * outer_product(n, n);
    for (unsigned int d = 0; d < 3; ++d)
      {
        rotation[d][d] += sc.second;
        rotation[d][(d + 1) % 3] -= sc.first * n[(d + 2) % 3];
        rotation[d][(d + 2) % 3] += sc.first * n[(d + 1) % 3];
      }
    return rotation;
  }

  Tensor<2, 3>
  parse_rotation(const std::string &text,
                 const unsigned int dim,
                 const std::string &entry)
  {
    const std::vector<double> numbers = to_numbers(text, entry);
    Tensor<1, 3>              axis({0, 0, 1});
    if (dim == 3 && numbers.size() == 4)
      axis = Tensor<1, 3>({numbers[0], numbers[1], numbers[2]});
    else if (numbers.size() != 1)
      throw InputError(entry + ": '" + text + "' is not " +
                       (dim == 2 ? "one angle in degrees. Give one number." :
                                   "an angle in degrees, nor an axis and " +
                                     std::string("an angle. Give 1 number "
                                                 "or 4.")));
    if (axis.norm() == 0)
      throw InputError(entry + ": the axis has length zero. Give a vector " +
                       "such as 0, 0, 1.");
    return rotation_about(axis, numbers.back());
  }

  void
  declare_placement(ParameterHandler &prm)
  {
    prm.declare_entry("Scale",
                      "1",
                      Patterns::Anything(),
                      "Factor on all coordinates of the body, above 0. The "
                      "body is scaled, then rotated, then moved. [-]");
    prm.declare_entry(
      "Rotation",
      "0",
      Patterns::Anything(),
      "Rotation about the origin, counter-clockwise: an angle about z, or "
      "in 3D an axis and an angle, 'x, y, z, angle'. [degrees]");
    prm.declare_entry("Translation",
                      "0",
                      Patterns::Anything(),
                      "Where the origin moves, 'x, y' (2D) or 'x, y, z' "
                      "(3D); 0 for nowhere. [length]");
  }

  Placement
  parse_placement(ParameterHandler  &prm,
                  const unsigned int dim,
                  const std::string &where)
  {
    const auto text = [&](const char *entry) { return trim(prm.get(entry)); };
    Placement  placement;
    placement.scale = parse_scale(text("Scale"), where + "Scale");
    placement.rotation =
      parse_rotation(text("Rotation"), dim, where + "Rotation");
    placement.translation =
      parse_translation(text("Translation"), dim, where + "Translation");
    return placement;
  }

  std::vector<BoundaryTag>
  parse_tags(const std::string &text, const std::string &entry)
  {
    std::vector<BoundaryTag> tags;
    for (const std::string &part : split(text, ';'))
      {
        const auto colon = part.find(':');
        if (colon == std::string::npos)
          throw InputError(entry + ": '" + part +
                           "' is not an id and a condition. Write " +
                           "'id: condition', such as 7: y > 79.9.");
        const auto        ids = conetact::to_ids(part.substr(0, colon), entry);
        const std::string condition = trim(part.substr(colon + 1));
        Expression        expression(condition, entry);
        if (ids.size() != 1)
          throw InputError(entry + ": '" + part +
                           "' has several ids. Give one a condition.");
        if (expression.uses_time())
          throw InputError(entry + ": '" + condition +
                           "' depends on time. A condition knows x, y and " +
                           "z only.");
        tags.push_back({*ids.begin(), condition, std::move(expression)});
      }
    return tags;
  }
} // namespace conetact::bodies
