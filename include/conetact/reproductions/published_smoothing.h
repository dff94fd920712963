// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_reproductions_published_smoothing_h
#define conetact_reproductions_published_smoothing_h

#include "conetact/solvers/contact_solver.h"

#include <string>
#include <vector>

namespace conetact::reproductions
{
  /**
   * Parameters of the published smoothing method. [K] does not print its own:
   * these were fitted to the iteration counts of its Tables 2 and 4.
   */
  struct PublishedSet
  {
    const char *name;
    double      eta, etabar, m0, beta0; ///< eps0 = m0
  };
  const std::vector<PublishedSet> &
  published_sets();

  /** What [K] prints of an increment, and what it is worth. */
  struct PublishedRun
  {
    unsigned int         iterations = 0; ///< linear solves
    double               natural = 0; ///< norm of x - P(x - y), in mixed units
    solvers::KannoErrors errors;
    double               residual = 0; ///< contact_residual(), without units
    std::string          failure;      ///< why it gave up; empty: it has not
  };

  /**
   * The smoothing and regularisation method of [K] (17) as published (see
   * SmoothingIteration), on the numbers of the problem in its units: from
   * x = y = 0, with no pivot frozen, until the natural residual is below the
   * tolerance. Iterations depend on the units. Free motions are eliminated
   * first (StiffnessForm): in [K] they are no unknowns of their own. To
   * reproduce tables and for nothing else: the method that solves problems is
   * in smoothing_newton.h.
   */
  PublishedRun
  solve_as_published(const solvers::ContactProblem &problem,
                     const PublishedSet            &set,
                     const double                   tolerance = 1e-8);
} // namespace conetact::reproductions

#endif
