// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/stages.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::application
{
  Stages::Stages(dealii::ParameterHandler       &prm,
                 const std::vector<std::string> &supports,
                 const RunSettings              &settings)
  {
    for (const std::string &name : supports)
      {
        const std::string in = "Support '" + name + "', ";
        prm.enter_subsection("Support " + name);
        activity.push_back(
          bodies::read_active(prm, in).value_or(Expression("1", in)));
        prm.leave_subsection();
      }
    if (ends(settings.times).size() < 2)
      return;
    if (settings.path.follows)
      throw InputError("Support, Active: a load path has the same supports all "
                       "along. Leave the entry at 1, or choose another "
                       "Solver/Method.");
    if (settings.adaptive.cycles > 0)
      throw InputError("Support, Active: a scene with Adaptive refinement has "
                       "the same supports all along. Leave the entry at 1, or "
                       "set Cycles to 0.");
  }



  bool
  Stages::may_change() const
  {
    return std::any_of(activity.begin(),
                       activity.end(),
                       [](const Expression &of) { return of.uses_time(); });
  }



  std::vector<bool>
  Stages::active(const double t) const
  {
    std::vector<bool> active;
    for (const Expression &of : activity)
      active.push_back(of(Point<3>(), t) != 0);
    return active;
  }



  std::vector<double>
  Stages::ends(const std::vector<double> &times) const
  {
    std::vector<double> result;
    for (std::size_t k = 0; may_change() && k + 1 < times.size(); ++k)
      if (active(times[k]) != active(times[k + 1]))
        result.push_back(times[k]);
    if (!times.empty())
      result.push_back(times.back());
    return result;
  }



  std::vector<double>
  Stages::times_of_last(const std::vector<double> &times) const
  {
    const std::vector<double> all    = ends(times);
    std::vector<double>       result = times;
    if (all.size() > 1)
      result.erase(result.begin(),
                   std::upper_bound(result.begin(),
                                    result.end(),
                                    all[all.size() - 2]));
    return result;
  }
} // namespace conetact::application
