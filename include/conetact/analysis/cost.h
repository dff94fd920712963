// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_cost_h
#define conetact_analysis_cost_h

#include "conetact/contact/contact_model.h"

#include <optional>
#include <string>

namespace conetact::analysis
{
  /** What an analysis will take, at most but for rounding. */
  struct Cost
  {
    std::optional<condensed::FactorEstimate> factor; ///< of condensed bodies
    double stiffness_bytes = 0;                      ///< condensed, dense
    double memory_bytes    = 0;                      ///< of the process
    double seconds         = 0; ///< on this machine, within a factor 2
    /** The same of each other one, where many share the work. */
    double memory_of_others = 0, seconds_of_others = 0;
  };

  /** Unknowns of the largest matrix that is factorised to condense it. */
  Eigen::Index
  largest_system(const contact::ContactModel &model);

  /**
   * Orders and analyses the elastic system, but factorises nothing. What was
   * done in this process so far counts, because a run does it, too; the rest
   * follows from the rate of a dense product, measured for some milliseconds.
   */
  Cost
  estimate_cost(const contact::ContactModel &model,
                const std::size_t            n_increments,
                const std::size_t            n_drawings,
                const int                    n_processes = 1);

  /** The same of a model that is solved iteratively by some processes. */
  Cost
  estimate_iterative_cost(const contact::ContactModel &model,
                          const std::size_t            n_increments,
                          const std::size_t            n_drawings,
                          const int                    n_processes = 1);

  /** What a scene that leaves the backend open is solved by, and why. */
  struct BackendChoice
  {
    const contact::ElasticityRow *row;
    std::string                   reason;
  };
  /**
   * By both estimates, where the condensation is large enough for it to matter.
   */
  BackendChoice
  cheaper_backend(const contact::ContactModel &model,
                  const std::size_t            n_increments,
                  const std::size_t            n_drawings);

  /** Whether this machine has the memory to condense it. */
  bool
  fits_condensed(const contact::ContactModel &model,
                 const std::size_t            n_increments,
                 const std::size_t            n_drawings);

  /**
   * Linear iterations of the iterative backend that take as long as to condense
   * the bodies and solve all increments then, by floating-point operations;
   * infinity: this machine has not the memory.
   */
  double
  iterations_of_condensing(const contact::ContactModel &model,
                           const std::size_t            n_increments,
                           const std::size_t            n_drawings);

  /** "12.3 MB". */
  std::string
  megabytes(const double bytes);

  /** Of this process until now [bytes]. */
  double
  peak_memory();
} // namespace conetact::analysis

#endif
