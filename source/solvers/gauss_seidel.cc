// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/gauss_seidel.h"

#include "conetact/solvers/fixed_cones.h"
#include "conetact/solvers/local_coulomb.h"
#include "conetact/solvers/stiffness_form.h"

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

namespace conetact::solvers
{
  namespace
  {
    /** Share of entries up to which a matrix is treated as a sparse one: each
     * of these takes an index besides, and no vectors of the processor. */
    constexpr double sparse_up_to = .25;

    /**
     * The loop over the nodes. It keeps the unknown x, that is r in compliance
     * and v in stiffness form, its image y = matrix x +- load, and what the
     * node's own solution says y should be: with that one the contact law
     * holds exactly, and the linear relation up to the residual.
     */
    class GaussSeidel : public ContactSolver
    {
    public:
      explicit GaussSeidel(const SolverOptions &given)
        : options(given)
      {}

      SolverReport
      solve(const ContactProblem &problem, ContactState &state) override;

    private:
      SolverReport
      solve_without_motions(const ContactProblem &problem, ContactState &state);
      void
      set_up(const std::shared_ptr<const ContactSystem> &new_system);
      void
      start(const ContactProblem &problem, const ContactState &state);
      Eigen::VectorXd
      image(const ContactProblem &problem) const;
      void
      add_columns(const Eigen::Index begin, const LocalCoulomb::Vector &step);
      bool
      sweep();
      void
      write(const ContactProblem &problem, ContactState &state);

      SolverOptions                        options;
      std::shared_ptr<const ContactSystem> system;
      std::optional<StiffnessForm>         eliminated; ///< of one with motions
      std::vector<LocalCoulomb>            local;
      Eigen::SparseMatrix<double>          sparse; ///< empty if the matrix is
                                                   ///< not
      Eigen::VectorXd x, y, y_of_node;
    };



    void
    GaussSeidel::set_up(const std::shared_ptr<const ContactSystem> &new_system)
    {
      if (system == new_system)
        return;
      system = new_system;
      local.clear();
      const double scale =
        system->matrix.trace() /
        static_cast<double>(std::max<Eigen::Index>(system->n_unknowns(), 1));
      for (Eigen::Index i = 0; i < system->n_nodes(); ++i)
        {
          const Eigen::Index begin = system->first[i];
          const Eigen::Index size  = system->first[i + 1] - begin;
          local.emplace_back(system->form,
                             system->matrix.block(begin, begin, size, size),
                             system->mu[i],
                             scale);
        }
      const double entries =
        static_cast<double>((system->matrix.array() != 0).count());
      sparse.resize(0, 0);
      if (entries < sparse_up_to * static_cast<double>(system->matrix.size()))
        sparse = system->matrix.sparseView();
    }



    /* W r + q or K (v - o) - f. */
    Eigen::VectorXd
    GaussSeidel::image(const ContactProblem &problem) const
    {
      const double          sign = system->form == Form::compliance ? 1 : -1;
      const Eigen::VectorXd p =
        problem.offset.size() > 0 ? Eigen::VectorXd(x - problem.offset) : x;
      if (sparse.size() > 0)
        return sparse * p + sign * problem.load;
      return system->matrix * p + sign * problem.load;
    }



    /* Columns of a node that has changed: a sweep costs n^2 at most, and less
       where nodes are done. */
    void
    GaussSeidel::add_columns(const Eigen::Index          begin,
                             const LocalCoulomb::Vector &step)
    {
      if (sparse.size() == 0)
        y.noalias() += system->matrix.middleCols(begin, step.size()) * step;
      else
        for (Eigen::Index k = 0; k < step.size(); ++k)
          for (Eigen::SparseMatrix<double>::InnerIterator e(sparse, begin + k);
               e;
               ++e)
            y(e.row()) += e.value() * step(k);
    }



    void
    GaussSeidel::start(const ContactProblem &problem, const ContactState &state)
    {
      const bool             compliance = system->form == Form::compliance;
      const Eigen::VectorXd &given      = compliance ? state.r : state.v;
      const Eigen::Index     n          = system->n_unknowns();
      x         = given.size() == n ? given : Eigen::VectorXd::Zero(n);
      y         = image(problem);
      y_of_node = y;
    }



    /* One pass over all nodes; false if it changed nothing at all. */
    bool
    GaussSeidel::sweep()
    {
      const bool           compliance = system->form == Form::compliance;
      bool                 changed    = false;
      LocalCoulomb::Vector v, r;
      for (Eigen::Index i = 0; i < system->n_nodes(); ++i)
        {
          const Eigen::Index         begin = system->first[i];
          const Eigen::Index         size  = system->first[i + 1] - begin;
          const LocalCoulomb::Vector own =
            local[i].matrix() * x.segment(begin, size);
          // v_i = W_ii r_i + q_i,  K_ii v_i = r_i + q_i
          const LocalCoulomb::Vector q =
            compliance ? LocalCoulomb::Vector(y.segment(begin, size) - own) :
                         LocalCoulomb::Vector(own - y.segment(begin, size));
          local[i].solve(q, v, r);
          y_of_node.segment(begin, size) = compliance ? v : r;
          const LocalCoulomb::Vector step =
            (compliance ? r : v) - x.segment(begin, size);
          if (step.isZero(0))
            continue;
          changed = true;
          x.segment(begin, size) += step;
          add_columns(begin, step);
        }
      return changed;
    }



    /* The image is computed afresh: increments gather round-off. */
    void
    GaussSeidel::write(const ContactProblem &problem, ContactState &state)
    {
      const bool compliance = system->form == Form::compliance;
      y                     = image(problem);
      state.r               = compliance ? x : y_of_node;
      state.v               = compliance ? y_of_node : x;
      state.u               = Eigen::VectorXd();
    }



    /* Motions have no reaction that a sweep could find: they are eliminated. */
    SolverReport
    GaussSeidel::solve_without_motions(const ContactProblem &problem,
                                       ContactState         &state)
    {
      if (!eliminated || !eliminated->is_of(problem.system))
        eliminated.emplace(problem.system);
      if (!eliminated->exists())
        {
          SolverReport report;
          report.reason = "contacts depend on each other";
          return report;
        }
      ContactState own    = eliminated->eliminate(state);
      const auto   report = solve(eliminated->eliminate(problem), own);
      state               = eliminated->expand(problem, own);
      return report;
    }



    SolverReport
    GaussSeidel::solve(const ContactProblem &problem, ContactState &state)
    {
      if (problem.system->n_motions > 0)
        return solve_without_motions(problem, state);
      SolverReport report;
      report.solver = "gauss-seidel";
      set_up(problem.system);
      start(problem, state);

      /* Other methods end exactly; this one creeps. What its residual leaves is
         an imbalance of forces, and the largest nodal force, by which a whole
         body's equilibrium is judged, may be far smaller than the residual's
         scale. So it goes on for two more digits, for as many sweeps again. */
      bool         changed = true, stopped = false;
      unsigned int last = options.max_sweeps;
      // the residual costs as much as a dense sweep
      const unsigned int check = sparse.size() > 0 ? 100 : 10;
      while (changed && !stopped && report.iterations < last)
        {
          changed = sweep();
          ++report.iterations;
          stopped = options.stop && options.stop();
          if (changed && !stopped && report.iterations % check != 0 &&
              report.iterations < last)
            continue;
          write(problem, state);
          report.residual = contact_residual(problem, state);
          if (!std::isfinite(report.residual) ||
              report.residual <= .01 * options.tolerance)
            break;
          if (report.residual <= options.tolerance)
            last = std::min(last, 2 * report.iterations);
        }
      if (report.residual <= options.tolerance)
        {
          report.converged = true;
          state.node       = classify(problem, state);
          return report;
        }
      std::ostringstream reason;
      reason << "Gauss-Seidel stopped "
             << (stopped ? "by the limit of time " : "") << "after "
             << report.iterations << " sweeps at a residual of "
             << report.residual;
      report.reason = reason.str();
      return report;
    }
  } // namespace



  std::unique_ptr<ContactSolver>
  make_gauss_seidel(const SolverOptions &options)
  {
    return with_fixed_cones(std::make_unique<GaussSeidel>(options), options);
  }
} // namespace conetact::solvers
