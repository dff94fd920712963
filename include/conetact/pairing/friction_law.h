// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_friction_law_h
#define conetact_pairing_friction_law_h

#include "conetact/base/expression.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace conetact::pairing
{
  /** Where and how a contact node presses and slips. */
  struct Situation
  {
    dealii::Point<3> position;        ///< undeformed [length]
    double           t           = 0; ///< at the end of the increment [time]
    double           temperature = 0; ///< change of its body's, at t [K]
    double           slipped     = 0; ///< way so far, at the start [length]
    double           pressure    = 0; ///< [stress]
    double           speed       = 0; ///< slip of the increment over its time
    /** Largest opening so far, at the start, or never_closed [length]. */
    double opened = 0;
    double gap    = 0; ///< at the start [length]
    double packed = 0; ///< largest pressure so far, at the start [stress]
    double shorn  = 0; ///< slip of a bond so far, in contact or not [length]
  };

  /** The names of its numbers in expressions, but for places and t. */
  const std::vector<std::string> &
  names_of_situation();
  /** Of an expression with those names. */
  double
  value_of(const Expression &expression, const Situation &at);

  /**
   * Friction that changes: |traction| <= min(mu p, shear limit), of both
   * expressions in x, y, z, t and T, s, p, v, which are the other members of
   * Situation. With a second coefficient the limit is an ellipse, whose
   * semi-axes are min(mu_1 p, shear limit) and min(mu_2 p, shear limit).
   */
  class FrictionLaw
  {
  public:
    /** `in` is what errors begin with. Throws InputError. An empty second
     * coefficient: friction is the same along both axes. */
    FrictionLaw(const std::string &coefficient,
                const std::string &second_coefficient,
                const std::string &shear_limit,
                const std::string &in);

    /** mu along the first axis, 0, or the second one, 1 [-]; of what does not
     * press yet, p = 0. */
    double
    coefficient(const Situation &at, const unsigned int axis = 0) const;
    /** No less than mu at any speed; infinite where nothing is known [-]. */
    double
    largest_coefficient(const Situation &at, const unsigned int axis) const;
    /** The same at any pressure. */
    double
    largest_coefficient_of_all(const Situation   &at,
                               const unsigned int axis) const;
    /** What the limit allows on an area [force]; infinite without one. */
    double
    largest_force(const Situation &at, const double area) const;

    /** Whether it is one coefficient of position. */
    bool
    is_constant() const;
    /** Whether mu follows from what is known before an increment is solved, and
     * nothing limits it. */
    bool
    is_known() const;
    /** Whether areas of nodes are needed. */
    bool
    needs_area() const;
    bool
    uses_temperature() const;
    bool
    uses_speed() const;
    /** Whether both axes have coefficients of their own. */
    bool
    is_elliptic() const
    {
      return second.has_value();
    }

    const Expression &
    expression(const unsigned int axis = 0) const
    {
      return axis > 0 && second ? *second : mu;
    }

  private:
    bool
    uses(const std::string &name) const;
    double
    most(const Situation   &at,
         const Bounds      &pressure,
         const unsigned int axis) const;

    Expression                mu;
    std::optional<Expression> second, tau;
  };
} // namespace conetact::pairing

#endif
