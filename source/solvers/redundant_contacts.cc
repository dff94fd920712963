// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/redundant_contacts.h"

#include "conetact/solvers/gauss_seidel.h"
#include "conetact/solvers/interior_point.h"
#include "conetact/solvers/node_sets.h"
#include "conetact/solvers/proximal_newton.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::VectorXd;

    /** Interior point steps at most, and in a row without half the residual. */
    constexpr unsigned int most_steps = 100, most_stalls = 15;

    /** Sweeps that are made before anything else. */
    constexpr unsigned int few_sweeps = 100;

    class RedundantContacts : public ContactSolver
    {
    public:
      explicit RedundantContacts(const SolverOptions &given)
        : options(given)
      {}

      SolverReport
      solve(const ContactProblem &problem, ContactState &state) override;

    private:
      void
      attach(const ContactProblem &given);
      bool
      stopped() const
      {
        return options.stop && options.stop();
      }
      /** Keeps a state if it is the best so far; true if it is a solution. */
      bool
      keep(const ContactState &state);
      bool
      polish(VectorXd p);
      bool
      relax(const unsigned int sweeps);
      bool
      find_inside(const bool coupled);

      SolverOptions                 options;
      std::optional<LinearRelation> relation;
      std::optional<SparseRelation> sparse;
      const ContactProblem         *problem = nullptr; ///< while solving
      ContactState                  best;
      SolverReport                  report;
    };



    void
    RedundantContacts::attach(const ContactProblem &given)
    {
      problem = &given;
      if (!relation || !relation->is(given.system))
        {
          relation.emplace(given.system);
          sparse.emplace(*relation);
        }
      relation->set_load(given);
      report          = SolverReport();
      report.solver   = "interior point";
      report.residual = std::numeric_limits<double>::infinity();
    }



    bool
    RedundantContacts::keep(const ContactState &state)
    {
      const double residual = contact_residual(*problem, state);
      if (residual < report.residual)
        {
          best            = state;
          report.residual = residual;
        }
      return report.residual <= options.tolerance;
    }



    /* Factorisations count as linear solves: each has one. */
    bool
    RedundantContacts::polish(VectorXd p)
    {
      ProximalNewton newton(*sparse);
      VectorXd       d;
      newton.polish(1e-14, options.stop, p, d);
      report.iterations += newton.n_factorizations();
      report.factorizations += newton.n_factorizations();

      ContactState state;
      relation->from_scaled(p, d, state);
      if (keep(state))
        return true;
      // The zeros of the states are exact only if the states are right: the
      // point without them has its chance first.
      set_exact_zeros(*relation, sets_of_point(*relation, p, d), p, d);
      relation->from_scaled(p, d, state);
      return keep(state);
    }



    /* Sweeps from the best state so far; their result is polished. */
    bool
    RedundantContacts::relax(const unsigned int sweeps)
    {
      SolverOptions few  = options;
      few.max_sweeps     = sweeps;
      ContactState state = best;
      report.iterations +=
        make_gauss_seidel(few)->solve(*problem, state).iterations;
      if (keep(state))
        return true;
      VectorXd p, d;
      relation->to_scaled(state, p, d);
      return polish(p);
    }



    /* Attempts to polish on the way: states are often known long before the
       residual is small. */
    bool
    RedundantContacts::find_inside(const bool coupled)
    {
      InteriorPoint iteration(*sparse, coupled);
      double        least = 1, tried = .1;
      VectorXd      r      = iteration.reactions();
      unsigned int  stalls = 0;
      for (unsigned int i = 0; i < most_steps && stalls < most_stalls; ++i)
        {
          if (stopped() || !iteration.step())
            break;
          ++report.iterations;
          ++report.factorizations;
          const VectorXd now = iteration.reactions();
          const double   residual =
            law_residual(*relation, now, sparse->dual(now));
          stalls = residual < .5 * least ? 0 : stalls + 1;
          if (!(residual < least))
            continue;
          least = residual;
          r     = now;
          // Not before another digit is gained: an attempt costs several
          // factorisations.
          if (least > .1 * tried)
            continue;
          tried = least;
          if (polish(r))
            return true;
          // Nothing more can be gained on this way.
          if (least < 1e-12)
            return false;
        }
      return !stopped() && least < tried && polish(r);
    }



    SolverReport
    RedundantContacts::solve(const ContactProblem &given, ContactState &state)
    {
      attach(given);
      best.v = best.r = VectorXd::Zero(given.load.size());
      if (state.r.size() == best.r.size())
        best = state;
      keep(best);

      // Cheap attempts first. Without the coupling of |z_t| the interior points
      // are slower, but find what the others miss.
      bool solved = relax(few_sweeps) || find_inside(true) ||
                    relax(4 * few_sweeps) || find_inside(false);
      for (unsigned int sweeps = 16 * few_sweeps;
           !solved && !stopped() && sweeps <= options.max_sweeps / 2;
           sweeps *= 2)
        solved = relax(sweeps);
      state            = best;
      report.converged = report.residual <= options.tolerance;
      if (report.converged)
        {
          state.node = classify(given, state);
          return report;
        }
      std::ostringstream text;
      text.precision(2);
      text << (stopped() ? "stopped by the limit of time" :
                           "neither interior points nor sweeps lead on")
           << " at a residual of " << report.residual;
      report.reason = text.str();
      return report;
    }
  } // namespace



  bool
  is_sparse_compliance(const ContactSystem &system)
  {
    if (system.form != Form::compliance || system.n_motions > 0 ||
        system.n_nodes() < 2)
      return false;
    // A contact of rigid bodies knows the contacts of its two bodies only; an
    // elastic body fills W.
    const auto entries =
      static_cast<double>((system.matrix.array() != 0).count());
    return entries < .5 * static_cast<double>(system.matrix.size());
  }



  std::unique_ptr<ContactSolver>
  make_redundant_contacts(const SolverOptions &options)
  {
    return std::make_unique<RedundantContacts>(options);
  }
} // namespace conetact::solvers
