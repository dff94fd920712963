// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_adaptive_refinement_h
#define conetact_analysis_adaptive_refinement_h

#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/output/output.h"

#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * Elements of each body (by their number) with the largest errors of all
   * bodies: the `fraction` of all elements, and those as bad as the last one.
   * None without error.
   */
  std::vector<std::set<unsigned int>>
  worst_elements(const std::vector<std::vector<double>> &errors,
                 const double                            fraction);

  /**
   * The meshes of a scene with adaptive refinement: its own one, then the one
   * before with its worst elements divided. Each is a row of refinement.csv.
   */
  class AdaptiveRefinement
  {
  public:
    /** Of each body, from the scene's own mesh to the one at hand. */
    const std::vector<bodies::Refinements> &
    refinements() const
    {
      return marked;
    }
    /** Meshes done. */
    unsigned int
    n_meshes() const
    {
      return n_done;
    }

    /**
     * Takes the last increment of the mesh at hand and marks elements of the
     * next one. Throws WriteError, AnalysisError at a non-finite number.
     */
    void
    advance(const application::Scene     &scene,
            const model::IncrementRecord &last,
            const std::filesystem::path  &folder,
            Log                          &log);

    /** All processes get what the first one has. */
    void
    share();

  private:
    std::vector<bodies::Refinements> marked;
    unsigned int                     n_done = 0;
    std::string                      table;
  };
} // namespace conetact::analysis

#endif
