// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/units.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact::output
{
  namespace
  {
    /** Names of force over area that people use. */
    std::string
    stress_name(const std::string &force, const std::string &length)
    {
      static const std::map<std::pair<std::string, std::string>, std::string>
                 known = {{{"N", "m"}, "Pa"},
                          {{"N", "mm"}, "MPa"},
                          {{"kN", "m"}, "kPa"},
                          {{"kN", "mm"}, "GPa"},
                          {{"MN", "m"}, "MPa"},
                          {{"lbf", "in"}, "psi"}};
      const auto found = known.find({force, length});
      return found != known.end() ? found->second : force + '/' + length + "^2";
    }

    /** What stands in XML as it is. */
    bool
    is_unit(const std::string &word)
    {
      return !word.empty() &&
             std::all_of(word.begin(), word.end(), [](const char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                      (c >= '0' && c <= '9') ||
                      std::string("^*/. -").find(c) != std::string::npos;
             });
    }
  } // namespace



  Units::Units(const std::string &text, const std::string &entry)
    : all(text)
  {
    if (text.empty())
      return;
    const std::vector<std::string> words = split(text, ',');
    if (words.size() < 2 || words.size() > 4 ||
        !std::all_of(words.begin(), words.end(), is_unit))
      throw InputError(entry + ": '" + text +
                       "' should be the units of force and length, then those "
                       "of time and temperature if you like, each of letters, "
                       "digits and ^*/.-, separated by commas: N, mm, s, K.");
    const std::string &force = words[0], &length = words[1];
    names = {{Quantity::force, force},
             {Quantity::length, length},
             {Quantity::moment, force + ' ' + length},
             {Quantity::stress, stress_name(force, length)}};
  }



  void
  Units::label(VtuGrid &grid) const
  {
    if (all.empty())
      return;
    grid.units          = all;
    grid.unit_of_points = names.at(Quantity::length);
    for (VtuField &field : grid.point_fields)
      {
        const auto found = quantities().find(field.name);
        if (found != quantities().end())
          field.unit = names.at(found->second);
      }
  }



  const std::map<std::string, Units::Quantity> &
  Units::quantities()
  {
    using Of                                           = Quantity;
    static const std::map<std::string, Quantity> table = {
      {"displacement", Of::length},
      {"gap", Of::length},
      {"slip", Of::length},
      {"u", Of::length},
      {"wear", Of::length},
      {"stress", Of::stress},
      {"von_mises", Of::stress},
      {"principal_stresses", Of::stress},
      {"axial_stress", Of::stress},
      {"contact_pressure", Of::stress},
      {"contact_traction", Of::stress},
      {"pressure", Of::stress},
      {"traction", Of::stress},
      {"reaction", Of::force},
      {"axial_force", Of::force},
      {"shear_force", Of::force},
      {"shear_force_y", Of::force},
      {"shear_force_z", Of::force},
      {"moment", Of::moment},
      {"moment_y", Of::moment},
      {"moment_z", Of::moment},
      {"torque", Of::moment}};
    return table;
  }
} // namespace conetact::output
