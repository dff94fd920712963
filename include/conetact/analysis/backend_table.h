// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_backend_table_h
#define conetact_analysis_backend_table_h

#include "conetact/analysis/cost.h"
#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/solvers/contact_solver.h"

#include <memory>
#include <vector>

namespace conetact::analysis
{
  /** A row of contact::elasticity_table() and what analyses do with it. */
  struct Backend
  {
    const contact::ElasticityRow *elasticity;
    /** Whether displacements of several increments are recovered at once. */
    bool batches;
    /** Processes that share its work. */
    int (*useful_processes)(const application::Scene    &scene,
                            const contact::ContactModel &model);
    Cost (*estimate)(const contact::ContactModel &model,
                     const std::size_t            n_increments,
                     const std::size_t            n_drawings,
                     const int                    n_processes);
    /** With other options than those of the scene. */
    std::unique_ptr<solvers::ContactSolver> (*create_solver)(
      const solvers::SolverOptions &options,
      const application::Scene     &scene,
      const contact::ContactModel  &model);
    /** Where increments go that it does not solve; null: nowhere. */
    const Backend *otherwise;
  };

  /** In the order of contact::elasticity_table(). */
  const std::vector<Backend> &
  backend_table();

  /** The one that a scene asks for, or the cheaper one; a word to the log. */
  const Backend &
  choose_backend(const application::Scene    &scene,
                 const contact::ContactModel &model,
                 Log                         &log);
} // namespace conetact::analysis

#endif
