// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_contact_solver_h
#define conetact_solvers_contact_solver_h

#include "conetact/solvers/contact_problem.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace conetact::solvers
{
  /**
   * Parameters of the smoothing and regularisation method, Hayashi,
   * Yamashita, Fukushima, SIAM J. Optim. 15 (2005) 593-615. The defaults are
   * for numbers without units.
   */
  struct SmoothingOptions
  {
    double rho            = .5;   ///< step reduction of the line search
    double sigma          = 1e-4; ///< sufficient decrease of the line search
    double kappa          = 1e-2; ///< bound of (m, eps) by the residual squared
    double kappahat       = 1;    ///< bound of m by the smallest eigenvalue
    double eta            = .5;   ///< decrease of beta
    double etabar         = .5;   ///< decrease of m and eps
    double m0             = 1e-2; ///< first smoothing parameter
    double eps0           = 1e-2; ///< first regularisation
    double beta0          = 1e3;  ///< first bound on the residual
    int    max_iterations = 300;  ///< linear solves before giving up

    /** Of linear systems, relative; 0: all of them are solved directly. */
    double precision = 1e-5;

    // bounds that rounding sets
    double smallest_m   = 1e-14;
    double smallest_eps = 1e-13;
    double frozen_pivot = 1e-8; ///< lambda of an open node stays below it

    std::function<bool()> stop = {}; ///< see SolverOptions
  };

  /** Options of all solvers, with defaults that need no tuning. */
  struct SolverOptions
  {
    std::string      method         = "automatic"; ///< a name of solver_table()
    double           tolerance      = 1e-10;       ///< on contact_residual()
    unsigned int     max_iterations = 100;         ///< Newton steps
    unsigned int     max_sweeps     = 20000;       ///< of Gauss-Seidel
    unsigned int     max_substeps   = 1024;        ///< of an increment
    SmoothingOptions smoothing;

    /** Sparse W may be that of rigid bodies, whose contacts are redundant. */
    bool may_be_rigid = true;

    /**
     * Asked in the outer loops, where there is one: true ends a solver with
     * what it has and the report of a failure (a limit of time).
     */
    std::function<bool()> stop = {};

    /** Asked where the fast method has not found an increment, and others are
     * left that may take long: true ends the solver there. */
    std::function<bool()> ends_early = {};

    /** Asked for what the fast method has found of the load: true, nothing
     * holds so much more of it (1: all of it). Where that is little, no other
     * method is tried. */
    std::function<bool(const ContactState &last, const double more)> is_limit =
      {};

    /**
     * Of large systems: asked where one way to an increment has failed after so
     * many linear iterations, and others take more of them. True: the increment
     * is left to another backend.
     */
    std::function<bool(unsigned int n_iterations)> leaves = {};
  };

  /**
   * Solves increments of one contact system, one after the other. May keep
   * what it learned (factors, states) from increment to increment as long as
   * the system is the same object.
   */
  class ContactSolver
  {
  public:
    virtual ~ContactSolver() = default;

    /**
     * Start of the increment in, end of the increment out (see ContactState).
     * A failure is a report, not an exception; the state is then of no use.
     * The report's residual is contact_residual() of the returned state, and
     * `converged` is never set where it exceeds the tolerance. Where the
     * increment was cut into parts (`substeps` > 1) it is the largest of the
     * parts: the slip is then the sum of theirs, and only the states and
     * reactions are those of the last.
     */
    virtual SolverReport
    solve(const ContactProblem &problem, ContactState &state) = 0;
  };
} // namespace conetact::solvers

#endif
