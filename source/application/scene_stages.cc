// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Stages of a scene: supports that are there in some of its increments only.

#include "conetact/application/scene.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::application
{
  namespace
  {
    /** Else there is one stage. */
    bool
    depend_on_time(const std::vector<Expression> &activity)
    {
      return std::any_of(activity.begin(),
                         activity.end(),
                         [](const Expression &of) { return of.uses_time(); });
    }
  } // namespace

  bool
  Scene::has_stages() const
  {
    return depend_on_time(activity);
  }



  void
  Scene::read_activity()
  {
    for (const std::string &name : support_names)
      {
        const std::string in = "Support '" + name + "', ";
        prm.enter_subsection("Support " + name);
        activity.push_back(
          bodies::read_active(prm, in).value_or(Expression("1", in)));
        prm.leave_subsection();
      }
    if (stage_ends().size() < 2)
      return;
    if (path.follows)
      throw InputError("Support, Active: a load path has the same supports all "
                       "along. Leave the entry at 1, or choose another "
                       "Solver/Method.");
    if (adaptive.cycles > 0)
      throw InputError("Support, Active: a scene with Adaptive refinement has "
                       "the same supports all along. Leave the entry at 1, or "
                       "set Cycles to 0.");
  }



  std::vector<bool>
  Scene::active_supports(const double t) const
  {
    std::vector<bool> active;
    for (const Expression &of : activity)
      active.push_back(of(Point<3>(), t) != 0);
    return active;
  }



  std::vector<double>
  Scene::stage_ends() const
  {
    std::vector<double> ends;
    const bool          may_change = has_stages();
    for (std::size_t k = 0; may_change && k + 1 < times.size(); ++k)
      if (active_supports(times[k]) != active_supports(times[k + 1]))
        ends.push_back(times[k]);
    if (!times.empty())
      ends.push_back(times.back());
    return ends;
  }



  std::vector<double>
  Scene::stage_times() const
  {
    const std::vector<double> ends   = stage_ends();
    std::vector<double>       result = times;
    if (ends.size() > 1)
      result.erase(result.begin(),
                   std::upper_bound(result.begin(),
                                    result.end(),
                                    ends[ends.size() - 2]));
    return result;
  }



  void
  Scene::take_stage(const double end, const std::filesystem::path &folder)
  {
    Assert(!times.empty() && end >= times.front(),
           dealii::ExcMessage("A stage has a time at least."));
    times.erase(std::remove_if(times.begin(),
                               times.end(),
                               [end](const double t) { return t > end; }),
                times.end());
    if (checkpoint_every == 0) // at its end only
      checkpoint_every = static_cast<unsigned int>(times.size());
    if (!folder.empty())
      continue_from(folder);
  }



  std::string
  Scene::why_not_anew(const std::map<unsigned int, std::string> &sliding) const
  {
    const auto &[contact, why] = *sliding.begin();
    return "Contact '" + contact_names[contact] +
           "' needs finite sliding in a stage of other supports: " + why +
           ". Set Kinematics = finite sliding for it";
  }
} // namespace conetact::application
