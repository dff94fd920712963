// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/backend_table.h"

#include "conetact/base/errors.h"
#include "conetact/base/process.h"
#include "conetact/base/team.h"
#include "conetact/iterative/large_stiffness.h"
#include "conetact/solvers/large_newton.h"
#include "conetact/solvers/solver_table.h"

#include <algorithm>

namespace conetact::analysis
{
  namespace
  {
    int
    only_one(const application::Scene &, const contact::ContactModel &)
    {
      return 1;
    }

    int
    processes_that_iterate(const application::Scene &,
                           const contact::ContactModel &model)
    {
      if (model.preconditioner != iterative::Preconditioner::aggregation)
        return 1;
      return iterative::useful_processes(model.coordinates.n_unknowns());
    }

    std::unique_ptr<solvers::ContactSolver>
    any_method(const solvers::SolverOptions &options,
               const application::Scene &,
               const contact::ContactModel &)
    {
      return solvers::make_solver(options);
    }

    /**
     * Without condensation an increment is solved as a whole, to begin with,
     * and left to condensed bodies once these are the faster way.
     */
    std::unique_ptr<solvers::ContactSolver>
    newton_while_it_pays(const solvers::SolverOptions &options,
                         const application::Scene     &scene,
                         const contact::ContactModel  &model)
    {
      constexpr double       few   = 500; // to ask what condensing takes
      solvers::SolverOptions whole = options;
      whole.max_substeps           = 1;
      whole.leaves = [&, worth = 0.](const unsigned int n_iterations) mutable {
        if (n_iterations < few)
          return false;
        if (worth == 0)
          {
            worth = iterations_of_condensing(model,
                                             scene.times.size(),
                                             scene.n_drawings());
            first_decides(worth);
          }
        return n_iterations > worth;
      };
      return std::make_unique<solvers::LargeNewton>(whole);
    }

    /**
     * The row of an Elasticity that the scene asks for, and why. What cannot be
     * iterated is condensed, as far as memory goes: a sentence says so.
     */
    std::pair<std::string, std::string>
    asked_for(const application::Scene    &scene,
              const contact::ContactModel &model,
              Log                         &log)
    {
      const contact::ElasticityRow &iterative = contact::iterative_row();
      const char *const             condensed = contact::condensed_row().name;
      if (scene.backend != application::Backend::iterative)
        return {condensed, "the scene asks for it"};
      const std::string why = iterative.why_not(model);
      if (why.empty())
        return {iterative.name, "the scene asks for it"};
      bool fits = fits_condensed(model, scene.times.size(), scene.n_drawings());
      first_decides(fits);
      if (!fits)
        throw InputError("Solver, Backend = iterative " + why +
                         ". Condensed bodies, which know it, take more memory "
                         "than this machine has: use coarser meshes.");
      log.say("Solver, Backend = iterative " + why + ". Bodies are condensed.");
      return {condensed, "the iterative one does not know all of the scene"};
    }

    /** The row of an Elasticity, and why. */
    std::pair<std::string, std::string>
    name_and_reason(const application::Scene    &scene,
                    const contact::ContactModel &model,
                    Log                         &log)
    {
      if (scene.backend != application::Backend::automatic)
        return asked_for(scene, model, log);
      if (scene.restart)
        return {scene.restart->state.get_text("backend"),
                "as in the run that is continued"};
      const BackendChoice choice =
        cheaper_backend(model, scene.times.size(), scene.n_drawings());
      std::string name = choice.row->name, reason = choice.reason;
      first_decides(name);
      first_decides(reason);
      return {name, reason};
    }

    std::string
    what_processes_do(const Backend               &backend,
                      const application::Scene    &scene,
                      const contact::ContactModel &model)
    {
      return backend.useful_processes(scene, model) > 1 ?
               "they share the linear systems" :
               "the first one does the work, the others have nothing to do";
    }
  } // namespace

  const std::vector<Backend> &
  backend_table()
  {
    static const Backend              condensed = {&contact::condensed_row(),
                                                   true,
                                                   &only_one,
                                                   &estimate_cost,
                                                   &any_method,
                                                   nullptr};
    static const std::vector<Backend> table     = {condensed,
                                                   {&contact::iterative_row(),
                                                    false,
                                                    &processes_that_iterate,
                                                    &estimate_iterative_cost,
                                                    &newton_while_it_pays,
                                                    &condensed}};
    return table;
  }

  const Backend &
  choose_backend(const application::Scene    &scene,
                 const contact::ContactModel &model,
                 Log                         &log)
  {
    const auto  choice = name_and_reason(scene, model, log);
    const auto &table  = backend_table();
    const auto  row =
      std::find_if(table.begin(), table.end(), [&](const Backend &backend) {
        return backend.elasticity->name == choice.first;
      });
    if (row == table.end())
      throw InputError("The checkpoint names a backend '" + choice.first +
                       "' that does not exist. Run the scene from its start.");
    if (scene.backend != application::Backend::condensed)
      log.note("backend: " + choice.first + ", " + choice.second);
    if (const unsigned int n = ProcessSession::n_processes(); n > 1)
      log.note(std::to_string(n) +
               " processes: " + what_processes_do(*row, scene, model));
    return *row;
  }
} // namespace conetact::analysis
