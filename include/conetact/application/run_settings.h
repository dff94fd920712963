// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_run_settings_h
#define conetact_application_run_settings_h

#include "conetact/application/adaptive_settings.h"
#include "conetact/application/solver_options.h"
#include "conetact/iterative/preconditioner.h"
#include "conetact/output/units.h"

#include <set>
#include <vector>

namespace conetact::application
{
  /** How a scene is solved and what is written of it. */
  struct RunSettings
  {
    std::vector<double>         times; ///< ends of increments
    solvers::SolverOptions      solver;
    const condensed::Condenser *condenser = &condensed::default_condenser();
    iterative::Preconditioner   preconditioner =
      iterative::Preconditioner::aggregation;
    Backend                backend = Backend::automatic;
    PathSettings           path;
    AdaptiveSettings       adaptive;
    bool                   judges_uniqueness = false;
    bool                   follows_branches  = false; ///< of all solutions
    unsigned int           vtu_every         = 1;
    output::Units          units;
    unsigned int           checkpoint_every = 0; ///< 0: never
    unsigned int           threads          = 1;
    std::set<unsigned int> fclib_increments; ///< with a file of their own
    std::set<unsigned int> text_increments;  ///< or stages of a load path

    /** Increments that are drawn. */
    std::size_t
    n_drawings() const
    {
      return vtu_every > 0 ? times.size() / vtu_every : 0;
    }
    /** Only the last of several meshes is drawn and has problem files. */
    void
    draw_nothing()
    {
      vtu_every = 0;
      fclib_increments.clear();
      text_increments.clear();
      judges_uniqueness = false;
      follows_branches  = false;
    }
  };

  /** All but what counts increments. Throws InputError. */
  RunSettings
  read_settings(dealii::ParameterHandler &prm);
  /**
   * Increments that have files, once it is known how many there are, and the
   * backend, which must have what they show; `verifies`: bodies are condensed
   * twice. Throws InputError.
   */
  void
  read_problem_increments(dealii::ParameterHandler &prm,
                          const bool                verifies,
                          RunSettings              &settings);
} // namespace conetact::application

#endif
