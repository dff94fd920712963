// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/friction_law.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace conetact::pairing
{
  const std::vector<std::string> &
  names_of_situation()
  {
    static const std::vector<std::string> names = {"T", "s", "p", "v"};
    return names;
  }

  double
  value_of(const Expression &expression, const Situation &at)
  {
    // It is asked for at each node in each step: memory for it is kept.
    thread_local std::vector<double> others;
    others = {at.temperature, at.slipped, at.pressure, at.speed};
    return expression(at.position, at.t, others);
  }

  FrictionLaw::FrictionLaw(const std::string &coefficient,
                           const std::string &second_coefficient,
                           const std::string &shear_limit,
                           const std::string &in)
    : mu(coefficient, in + "Friction coefficient", names_of_situation())
  {
    if (!trim(second_coefficient).empty())
      second.emplace(second_coefficient,
                     in + "Second friction coefficient",
                     names_of_situation());
    if (trim(shear_limit).empty())
      return;
    tau.emplace(shear_limit, in + "Shear limit", names_of_situation());
    for (const char *of_solution : {"p", "v"})
      if (tau->uses(of_solution))
        throw InputError(in + "Shear limit: it depends on " + of_solution +
                         ". A limit is known before the increment is solved: "
                         "use x, y, z, t, T and s, and write what depends on "
                         "pressure or speed into Friction coefficient.");
  }

  double
  FrictionLaw::coefficient(const Situation &at, const unsigned int axis) const
  {
    return value_of(expression(axis), at);
  }

  /* An upper bound by interval arithmetic, over all speeds and over the
     pressures that are given. It may be above what is ever reached: a proof
     that friction cannot hold a load stays one. */
  double
  FrictionLaw::most(const Situation   &at,
                    const Bounds      &pressure,
                    const unsigned int axis) const
  {
    const double far = std::numeric_limits<double>::infinity();
    return std::max(0.,
                    expression(axis)
                      .bounds(at.position,
                              at.t,
                              {{at.temperature, at.temperature},
                               {at.slipped, at.slipped},
                               pressure,
                               {0, far}})
                      .high);
  }

  double
  FrictionLaw::largest_coefficient(const Situation   &at,
                                   const unsigned int axis) const
  {
    return most(at, {at.pressure, at.pressure}, axis);
  }

  double
  FrictionLaw::largest_coefficient_of_all(const Situation   &at,
                                          const unsigned int axis) const
  {
    return most(at, {0, std::numeric_limits<double>::infinity()}, axis);
  }

  bool
  FrictionLaw::uses(const std::string &name) const
  {
    return mu.uses(name) || (second && second->uses(name));
  }

  /** The Shear limit tau as a force of a node, tau times its area. */
  double
  FrictionLaw::largest_force(const Situation &at, const double area) const
  {
    return tau ? value_of(*tau, at) * area :
                 std::numeric_limits<double>::infinity();
  }

  /* A number for each node, known before the run: it needs no law in
     increments, and solvers see the coefficient alone. */
  bool
  FrictionLaw::is_constant() const
  {
    bool uses_others = false;
    for (const std::string &name : names_of_situation())
      uses_others = uses_others || uses(name);
    return !tau && !mu.uses_time() && !(second && second->uses_time()) &&
           !uses_others;
  }

  /* A number for each node in an increment, known before it is solved. */
  bool
  FrictionLaw::is_known() const
  {
    return !tau && !uses("p") && !uses("v");
  }

  bool
  FrictionLaw::needs_area() const
  {
    return tau || uses("p");
  }

  bool
  FrictionLaw::uses_speed() const
  {
    return uses("v");
  }

  bool
  FrictionLaw::uses_temperature() const
  {
    return uses("T") || (tau && tau->uses("T"));
  }
} // namespace conetact::pairing
