// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/fixed_cones.h"

#include <limits>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    /**
     * A fixed-point iteration, mu_k+1 = f(r_k, slip_k) / r_n,k at each node,
     * from the start of the increment each time but for reactions. It gives up
     * after a hundred solutions: nothing makes it contract where friction
     * varies much with reactions or slips.
     */
    class FixedCones : public ContactSolver
    {
    public:
      FixedCones(std::unique_ptr<ContactSolver> m, const SolverOptions &o)
        : method(std::move(m))
        , options(o)
      {}

      SolverReport
      solve(const ContactProblem &problem, ContactState &state) override
      {
        return problem.laws ? repeat(problem, state) :
                              method->solve(problem, state);
      }

    private:
      SolverReport
      repeat(const ContactProblem &problem, ContactState &state)
      {
        constexpr unsigned int most   = 100;
        constexpr double       enough = 1e-3; // of the tolerance
        const ContactState     start  = state;
        SolverReport           sum;
        double                 before = std::numeric_limits<double>::infinity();
        if (problem.laws->has_bonds() || problem.laws->has_ellipses())
          {
            sum.reason = problem.laws->has_bonds() ?
                           "this method knows no cohesion" :
                           "this method knows no ellipses that vary";
            return sum;
          }
        if (problem.laws->has_layers() &&
            problem.system->form == Form::stiffness)
          {
            sum.reason = "this method knows layers that give way in the "
                         "compliance form only";
            return sum;
          }
        for (unsigned int i = 0; i < most; ++i)
          {
            const ContactProblem cones = with_coefficients_of(state, problem);
            ContactState         trial = start;
            trial.r                    = state.r;
            SolverReport report        = method->solve(cones, trial);
            add_work(report, sum);
            sum   = report;
            state = trial;
            take_layers_away(problem, state);
            if (!sum.converged)
              return sum;
            // The residual is that of the laws that vary. A tolerance that is
            // reached is enough once nothing more is gained.
            sum.residual = contact_residual(problem, state);
            if (sum.residual <= enough * options.tolerance ||
                (sum.residual <= options.tolerance &&
                 !(sum.residual < .5 * before)))
              return sum;
            before = sum.residual;
          }
        sum.converged = false;
        sum.reason    = "the coefficient of friction does not settle";
        return sum;
      }

      /** Their part in v; the method has them in the compliance. */
      static void
      take_layers_away(const ContactProblem &problem, ContactState &state)
      {
        const Eigen::Index n = problem.system->n_contact_unknowns();
        if (!problem.laws->has_layers())
          return;
        const Eigen::VectorXd v =
          multiply(*problem.system, state.r) + problem.load;
        state.v.head(n) = v.head(n);
      }

      std::unique_ptr<ContactSolver> method;
      SolverOptions                  options;
    };
  } // namespace

  std::unique_ptr<ContactSolver>
  with_fixed_cones(std::unique_ptr<ContactSolver> method,
                   const SolverOptions           &options)
  {
    return std::make_unique<FixedCones>(std::move(method), options);
  }
} // namespace conetact::solvers
