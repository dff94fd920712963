// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/run_settings.h"

#include "conetact/application/load_history.h"
#include "conetact/output/problem_files.h"

#include <string>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    unsigned int
    count(const Handler &prm, const std::string &entry)
    {
      return static_cast<unsigned int>(prm.get_integer(entry));
    }
  } // namespace

  RunSettings
  read_settings(Handler &prm)
  {
    RunSettings settings;
    settings.adaptive = create_adaptive(prm);
    prm.enter_subsection("Time");
    settings.times = create_times(prm);
    prm.leave_subsection();
    prm.enter_subsection("Solver");
    settings.solver    = create_solver_options(prm);
    settings.condenser = &chosen_condenser(prm);
    settings.preconditioner =
      iterative::preconditioner_named(prm.get("Preconditioner"));
    settings.path             = create_path_settings(prm);
    settings.follows_branches = follows_branches(prm);
    settings.threads          = count(prm, "Threads");
    prm.leave_subsection();
    prm.enter_subsection("Output");
    settings.vtu_every        = count(prm, "VTU");
    settings.units            = {prm.get("Units"), "Output, Units"};
    settings.checkpoint_every = count(prm, "Checkpoint");
    prm.leave_subsection();
    return settings;
  }

  void
  read_problem_increments(Handler     &prm,
                          const bool   verifies,
                          RunSettings &settings)
  {
    prm.enter_subsection("Output");
    const auto increments_of = [&](const std::string &entry) {
      return output::parse_problem_increments(prm.get(entry),
                                              static_cast<unsigned int>(
                                                settings.times.size()),
                                              "Output, " + entry);
    };
    settings.fclib_increments = increments_of("FCLib increments");
    settings.text_increments  = increments_of("Text increments");
    output::check_fclib_is_there(settings.fclib_increments);
    settings.judges_uniqueness = prm.get("Uniqueness") == "yes";
    prm.leave_subsection();
    prm.enter_subsection("Solver");
    settings.backend =
      chosen_backend(prm,
                     settings.judges_uniqueness ? "Output, Uniqueness" :
                     !settings.fclib_increments.empty() ?
                                                  "Output, FCLib increments" :
                     !settings.text_increments.empty() ?
                                                  "Output, Text increments" :
                     verifies ? "the option --verify" :
                                "");
    prm.leave_subsection();
  }
} // namespace conetact::application
