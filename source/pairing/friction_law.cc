// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/friction_law.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

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
    return expression(at.position,
                      at.t,
                      {at.temperature, at.slipped, at.pressure, at.speed});
  }

  FrictionLaw::FrictionLaw(const std::string &coefficient,
                           const std::string &shear_limit,
                           const std::string &in)
    : mu(coefficient, in + "Friction coefficient", names_of_situation())
  {
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
  FrictionLaw::coefficient(const Situation &at) const
  {
    return value_of(mu, at);
  }

  double
  FrictionLaw::largest_force(const Situation &at, const double area) const
  {
    return tau ? value_of(*tau, at) * area :
                 std::numeric_limits<double>::infinity();
  }

  bool
  FrictionLaw::is_constant() const
  {
    bool uses_others = false;
    for (const std::string &name : names_of_situation())
      uses_others = uses_others || mu.uses(name);
    return !tau && !mu.uses_time() && !uses_others;
  }

  bool
  FrictionLaw::is_known() const
  {
    return !tau && !mu.uses("p") && !mu.uses("v");
  }

  bool
  FrictionLaw::needs_area() const
  {
    return tau || mu.uses("p");
  }

  bool
  FrictionLaw::uses_speed() const
  {
    return mu.uses("v");
  }

  bool
  FrictionLaw::uses_temperature() const
  {
    return mu.uses("T") || (tau && tau->uses("T"));
  }
} // namespace conetact::pairing
