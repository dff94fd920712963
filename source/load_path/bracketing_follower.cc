// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/load_path.h"
#include "conetact/solvers/existence.h"
#include "conetact/solvers/null_space.h"
#include "conetact/solvers/solver_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    // Parts of the stage:
    constexpr double bracket      = 1e-8; ///< width around an event
    constexpr double first_step   = .05;
    constexpr double largest_step = .2;
    constexpr double shortest     = 1e-4; ///< increment that is cut for a turn
    constexpr double at_bound     = 1e-6; ///< a path this close has reached it
    constexpr double crowded      = 1e-5; ///< see most_near
    constexpr double largest_turn = .05;  ///< of a slip in an increment [rad]
    /** Of largest force over mean stiffness: more motion in no time is a jump.
     */
    constexpr double jump_size = 1e-3;

    /**
     * After so many events less than `crowded` apart the next step is of that
     * length whatever changes in it.
     */
    constexpr unsigned int most_near = 8;

    PathState
    path_state(const solvers::NodeState state)
    {
      return state == solvers::NodeState::open  ? PathState::open :
             state == solvers::NodeState::stick ? PathState::stick :
                                                  PathState::slip;
    }

    class BracketingFollower : public PathFollower
    {
    public:
      BracketingFollower(std::shared_ptr<const solvers::ContactSystem> system,
                         const VectorXd                               &gap,
                         const PathOptions                            &options);
      PathResult
      follow(const PathStage &stage, const PathVisitor &visit) override;

    private:
      using States = std::vector<solvers::NodeState>;
      /** An increment from `now`. */
      struct Trial
      {
        double      parameter = 0; ///< at its end
        bool        converged = false;
        bool        jump      = false; ///< the change is one of displacements
        VectorXd    v, r;              ///< total
        States      states;
        std::string reason;
      };

      VectorXd
      load(const double parameter) const;
      Trial
      increment(const double parameter);
      bool
      goes_on(const Trial &trial) const;
      double
      turn(const Trial &trial) const;
      void
      begin(const PathStage &next);
      Trial
      step(const double target);
      Trial
      first_change(Trial other);
      bool
      is_jump(const VectorXd &motion) const;
      void
      move_to(const Trial &trial);
      bool
      look_ahead(const double target);
      PathResult
      end_of_path(const std::string &reason) const;
      VectorXd
      slip_directions() const;
      VectorXd
      mechanism(const VectorXd           &guess,
                const std::vector<Index> &touching) const;

      std::shared_ptr<const solvers::ContactSystem> system;
      PathOptions                                   options;
      std::unique_ptr<solvers::ContactSolver>       solver;
      solvers::ExistenceCheck                       existence;

      PathStage          stage;
      double             range = 1; ///< of the stage
      solvers::Existence refusal;   ///< of the load at the end of the stage
      double             bound = 0; ///< no load beyond it can be balanced

      PathPoint    now;
      States       states; ///< of the increments after `now`
      double       length        = 0;
      double       largest_force = 0;
      unsigned int n_near        = 0;
    };



    BracketingFollower::BracketingFollower(
      std::shared_ptr<const solvers::ContactSystem> s,
      const VectorXd                               &gap,
      const PathOptions                            &o)
      : system(std::move(s))
      , options(o)
      , existence(system)
    {
      solvers::SolverOptions of_increments;
      of_increments.tolerance = options.tolerance;
      // Parts of an increment would have another answer, and hide a change.
      of_increments.max_substeps = 1;
      solver                     = solvers::make_solver(of_increments);
      now.v = now.r = VectorXd::Zero(system->n_unknowns());
      for (Index i = 0; i < system->n_nodes(); ++i)
        now.v[system->normal(i)] = gap[i];
    }



    VectorXd
    BracketingFollower::load(const double parameter) const
    {
      return stage.load + (parameter - stage.begin) * stage.rate;
    }



    BracketingFollower::Trial
    BracketingFollower::increment(const double parameter)
    {
      const Index             n = system->n_nodes();
      solvers::ContactProblem problem;
      VectorXd                slipped = now.v; // before the increment
      problem.system                  = system;
      problem.gap.resize(n);
      solvers::ContactState state;
      state.v = VectorXd::Zero(now.v.size());
      for (Index i = 0; i < n; ++i)
        {
          const Index k  = system->normal(i);
          problem.gap[i] = state.v[k] = now.v[k];
          slipped[k]                  = 0;
        }
      // K (slipped + v) = r + f: what has slipped so far is part of the load.
      problem.load            = load(parameter) - system->matrix * slipped;
      problem.reference_force = largest_force;
      state.r                 = now.r;
      state.node              = states;

      Trial                       trial;
      const solvers::SolverReport report = solver->solve(problem, state);
      trial.parameter                    = parameter;
      trial.converged =
        report.converged &&
        solvers::contact_residual(problem, state) <= options.tolerance;
      trial.reason = report.reason;
      trial.v      = state.v + slipped;
      trial.r      = state.r;
      trial.states = state.node;
      return trial;
    }



    bool
    BracketingFollower::goes_on(const Trial &trial) const
    {
      return trial.converged && trial.states == states;
    }



    /* Of friction where it slips: the law sees one direction an increment. */
    double
    BracketingFollower::turn(const Trial &trial) const
    {
      double largest = 0;
      for (Index i = 0; i < system->n_nodes(); ++i)
        {
          const auto k = static_cast<std::size_t>(i);
          if (system->n_tangents(i) < 2 ||
              trial.states[k] != solvers::NodeState::slip ||
              states[k] != solvers::NodeState::slip)
            continue;
          const Eigen::Vector2d a = now.r.segment<2>(system->first[k]),
                                b = trial.r.segment<2>(system->first[k]);
          if (a.norm() > 0 && b.norm() > 0)
            largest = std::max(
              largest,
              std::acos(std::clamp(a.dot(b) / (a.norm() * b.norm()), -1., 1.)));
        }
      return largest;
    }



    void
    BracketingFollower::begin(const PathStage &next)
    {
      stage         = next;
      range         = stage.end - stage.begin;
      length        = first_step * range;
      now.parameter = stage.begin;
      now.changes.clear();
      now.jump                = false;
      n_near                  = 0;
      const VectorXd load_end = load(stage.end);
      largest_force           = std::max({largest_force,
                                          stage.load.lpNorm<Eigen::Infinity>(),
                                          load_end.lpNorm<Eigen::Infinity>()});
      // A necessary condition for the whole stage at once: no path leads beyond
      // it, so that no increment need fail there.
      refusal = existence.check(load_end, -now.r, largest_force);
      bound   = refusal.admissible ? std::numeric_limits<double>::infinity() :
                                     stage.begin + refusal.fraction * range;
    }



    /* The longest step without a change, or the first change. */
    BracketingFollower::Trial
    BracketingFollower::step(const double target)
    {
      if (n_near >= most_near)
        {
          n_near = 0;
          // Of events so close together their order means nothing: the step
          // takes them as one.
          return increment(std::min(now.parameter + crowded * range, target));
        }
      while (true)
        {
          const double end = now.parameter + length;
          Trial        trial =
            increment(end > target - bracket * range ? target : end);
          if (!goes_on(trial))
            trial = first_change(std::move(trial));
          // Shorter increments turn less; a slip that turns at once, as after
          // an event, would be cut for ever.
          const bool short_enough = length <= shortest * range;
          if (!trial.converged || short_enough || turn(trial) <= largest_turn)
            {
              length = std::min(2 * length, largest_step * range);
              return trial;
            }
          length /= 2;
        }
    }



    bool
    BracketingFollower::is_jump(const VectorXd &motion) const
    {
      const double stiffness =
        system->matrix.trace() / static_cast<double>(motion.size());
      return stiffness * solvers::largest(motion) > jump_size * largest_force;
    }



    /* By bisection; where no increment beyond it converges, the last that does,
       without a change. */
    BracketingFollower::Trial
    BracketingFollower::first_change(Trial other)
    {
      Trial same;
      same.parameter = now.parameter;
      same.v         = now.v;
      while (other.parameter - same.parameter > bracket * range)
        {
          Trial middle = increment(.5 * (same.parameter + other.parameter));
          (goes_on(middle) ? same : other) = std::move(middle);
        }
      // An increment beyond the change is taken with it. Without one the path
      // ends at the last that converged.
      if (other.converged && same.parameter > stage.begin + bracket * range)
        other.jump = is_jump(other.v - same.v);
      if (other.converged || !same.converged)
        return other;
      same.reason = other.reason;
      return same;
    }



    void
    BracketingFollower::move_to(const Trial &trial)
    {
      const PathPoint before = now;
      n_near =
        trial.parameter - now.parameter < crowded * range ? n_near + 1 : 0;
      now.parameter = trial.parameter;
      now.v         = trial.v;
      now.r         = trial.r;
      largest_force = std::max(largest_force, now.r.lpNorm<Eigen::Infinity>());
      now.changes.clear();
      now.jump = trial.jump;
      now.residual =
        path_residual(*system, options, load(now.parameter), before, now);
    }



    /* An increment too short for another event tells how the path goes on. */
    bool
    BracketingFollower::look_ahead(const double target)
    {
      const double end = now.parameter + 2 * bracket * range;
      if (end > target)
        return true;
      const Trial trial = increment(end);
      if (!trial.converged)
        return false;
      states = trial.states;
      for (Index i = 0; i < system->n_nodes(); ++i)
        {
          const auto      k  = static_cast<std::size_t>(i);
          const PathState to = path_state(states[k]);
          if (k >= now.state.size()) // the path begins
            now.state.push_back(to);
          else if (now.state[k] != to)
            {
              now.changes.push_back({i, now.state[k], to});
              now.state[k] = to;
            }
        }
      return true;
    }



    PathResult
    BracketingFollower::follow(const PathStage &next, const PathVisitor &visit)
    {
      begin(next);
      // At the bound itself the reactions are at the border of what is
      // possible.
      const double target = std::min(stage.end, bound - .5 * bracket * range);
      if (target > now.parameter && !look_ahead(target))
        return end_of_path("no increment converges at its start");
      if (!now.changes.empty())
        visit(now);
      while (now.parameter < target)
        {
          const Trial trial = step(target);
          if (!trial.converged)
            return end_of_path(trial.reason);
          const bool same = goes_on(trial);
          move_to(trial);
          const bool ahead =
            (same && trial.reason.empty()) || look_ahead(target);
          visit(now);
          if (!ahead || !trial.reason.empty())
            return end_of_path(trial.reason);
        }
      if (bound <= stage.end)
        return end_of_path("");
      PathResult result;
      result.outcome   = PathOutcome::target_reached;
      result.parameter = now.parameter;
      return result;
    }



    PathResult
    BracketingFollower::end_of_path(const std::string &reason) const
    {
      PathResult result;
      result.parameter = now.parameter;
      result.reason    = reason;
      // The proof of the existence check: here the limit is known exactly, and
      // with it the mechanism.
      if (now.parameter >= bound - at_bound * range)
        {
          result.outcome   = PathOutcome::limit_load;
          result.parameter = bound;
          result.reason    = "no reactions can balance a larger load";
          result.mechanism = mechanism(refusal.v, refusal.tight);
        }
      // Something floats, and Coulomb's limit lies below that of the check:
      // friction is not associated.
      else if (existence.basis().cols() > 0)
        {
          std::vector<Index> touching;
          for (Index i = 0; i < system->n_nodes(); ++i)
            if (now.r[system->normal(i)] > 0)
              touching.push_back(i);
          result.outcome   = PathOutcome::limit_load;
          result.reason    = "the path ends here, though reactions that obey "
                             "no law of slip could balance a larger load";
          result.mechanism = mechanism(slip_directions(), touching);
        }
      else if (now.parameter > stage.begin)
        result.reason =
          "in space increments of growing loads are followed only, and none "
          "beyond this point finds an equilibrium. Where the path turns, or "
          "jumps far, they find none: " +
          reason;
      return result;
    }



    VectorXd
    BracketingFollower::slip_directions() const
    {
      VectorXd v = VectorXd::Zero(now.r.size());
      for (Index i = 0; i < system->n_nodes(); ++i)
        {
          const auto   k     = static_cast<std::size_t>(i);
          const Index  first = system->first[k], t = system->n_tangents(i);
          const double size = now.r.segment(first, t).norm();
          if (now.state[k] != PathState::open && size > 0)
            // Bodies are about to slip against the friction they meet.
            v.segment(first, t) = -now.r.segment(first, t) / size;
        }
      return v;
    }



    /* Motions without strain that keep `touching` closed, nearest to a guess:
       Coulomb's slip does not dilate as a proof of the existence check does. */
    VectorXd
    BracketingFollower::mechanism(const VectorXd           &guess,
                                  const std::vector<Index> &touching) const
    {
      const MatrixXd &R = existence.basis();
      MatrixXd        closing(static_cast<Index>(touching.size()), R.cols());
      for (std::size_t k = 0; k < touching.size(); ++k)
        // v_n = 0 at the nodes that stay closed.
        closing.row(static_cast<Index>(k)) = R.row(system->normal(touching[k]));
      MatrixXd free = R;
      if (!touching.empty())
        {
          Eigen::FullPivLU<MatrixXd> factor;
          factor.setThreshold(1e-8);
          free = R * factor.compute(closing).kernel();
        }
      const MatrixXd basis = solvers::orthonormal_basis(free);
      VectorXd       v     = basis * (basis.transpose() * guess);
      if (!(v.norm() > 1e-6 * guess.norm()))
        v = R * (R.transpose() * guess);
      return v.norm() > 0 ? VectorXd(v / v.lpNorm<Eigen::Infinity>()) : guess;
    }
  } // namespace



  std::unique_ptr<PathFollower>
  make_bracketing_follower(std::shared_ptr<const solvers::ContactSystem> system,
                           const VectorXd                               &gap,
                           const PathOptions &options)
  {
    eigen_assert(gap.size() == system->n_nodes());
    return std::make_unique<BracketingFollower>(std::move(system),
                                                gap,
                                                options);
  }
} // namespace conetact::load_path
