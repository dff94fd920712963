// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/friction_ellipse.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    using solvers::FrictionLimit;

    /** One semi-axis has at least this part of the other one: formulas that
     * divide by it stay finite, and it is far below any tolerance. */
    constexpr double least_ratio = 1e-12;

    bool
    presses(const FrictionLimit &one, const FrictionLimit &two)
    {
      return std::max(one.value, two.value) > 0;
    }

    FrictionLimit
    times(const double factor, const FrictionLimit &f)
    {
      return {factor * f.value,
              factor * f.by_force,
              factor * f.by_slip,
              factor * f.by_gap};
    }

    /**
     * Lengthens the shorter axis to that, with the slopes of the longer one.
     */
    void
    lengthen(FrictionLimit &one, FrictionLimit &two)
    {
      if (one.value < least_ratio * two.value)
        one = times(least_ratio, two);
      else if (two.value < least_ratio * one.value)
        two = times(least_ratio, one);
    }

    /** Adds a one + b two, with all slopes. */
    FrictionLimit
    sum(const double         a,
        const FrictionLimit &one,
        const double         b,
        const FrictionLimit &two)
    {
      return {a * one.value + b * two.value,
              a * one.by_force + b * two.by_force,
              a * one.by_slip + b * two.by_slip,
              a * one.by_gap + b * two.by_gap};
    }

    /** The shape of an ellipse that shrinks to a point is that of its slopes by
     * r_n, which take the place of the limits. */
    FrictionLimit
    without_pressure(const FrictionLimit &f)
    {
      return {std::max(f.by_force, 0.), 0, 0, 0};
    }
  } // namespace

  /* f = sqrt(f_1 f_2), and by any variable f' = f/2 (f_1'/f_1 + f_2'/f_2). */
  FrictionLimit
  mean(const FrictionLimit &first, const FrictionLimit &second)
  {
    FrictionLimit one = first, two = second;
    if (!presses(one, two))
      {
        one = without_pressure(one);
        two = without_pressure(two);
        lengthen(one, two);
        const double slope = std::sqrt(one.value * two.value);
        // The limit of a pull is negative, as a cone goes on below its vertex.
        const double force =
          std::sqrt(std::abs(first.value) * std::abs(second.value));
        return {-force, slope, 0, 0};
      }
    lengthen(one, two);
    const double  f = std::sqrt(one.value * two.value);
    FrictionLimit result =
      sum(.5 * f / one.value, one, .5 * f / two.value, two);
    result.value = f;
    return result;
  }

  /* f = 1 / |(c_1 / f_1, c_2 / f_2)|, and by any variable f' = sum_k c_k^2 (f /
     f_k)^3 f_k'. A cosine of 0 must not be divided by a limit of 0. */
  FrictionLimit
  cut(const FrictionLimit &first,
      const FrictionLimit &second,
      const double         cosine_1,
      const double         cosine_2)
  {
    Assert(std::abs(std::hypot(cosine_1, cosine_2) - 1) < 1e-6,
           dealii::ExcMessage("Cosines are those of a direction."));
    constexpr double little = 1e-12;
    const double     c1     = std::abs(cosine_1) > little ? cosine_1 : 0.;
    const double     c2     = std::abs(cosine_2) > little ? cosine_2 : 0.;
    const auto       of     = [&](const double one, const double two) {
      const double inverse =
        std::hypot(c1 == 0 ? 0. : c1 / one, c2 == 0 ? 0. : c2 / two);
      return inverse > 0 && std::isfinite(inverse) ? 1 / inverse : 0.;
    };
    if (!presses(first, second))
      return {-of(std::abs(first.value), std::abs(second.value)),
              of(first.by_force, second.by_force),
              0,
              0};
    const double f = of(first.value, second.value);
    if (f == 0)
      return {};
    const auto cubed = [&](const double c, const double value) {
      return c == 0 ? 0. : c * c * std::pow(f / value, 3);
    };
    FrictionLimit result =
      sum(cubed(c1, first.value), first, cubed(c2, second.value), second);
    result.value = f;
    return result;
  }

  /* a = f_1 / sqrt(f_1 f_2) = sqrt(f_1 / f_2), a' = a/2 (f_1'/f_1 -
     f_2'/f_2). */
  solvers::Aspect
  aspect_of(FrictionLimit one, FrictionLimit two)
  {
    if (!presses(one, two))
      {
        one = without_pressure(one);
        two = without_pressure(two);
      }
    lengthen(one, two);
    if (!(one.value > 0) || !(two.value > 0))
      return {}; // without friction there is no ellipse
    const double        a = std::sqrt(one.value / two.value);
    const FrictionLimit by =
      sum(.5 * a / one.value, one, -.5 * a / two.value, two);
    return {a, by.by_force, by.by_slip, by.by_gap};
  }
} // namespace conetact::contact
