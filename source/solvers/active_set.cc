// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/active_set.h"

#include "conetact/solvers/unloaded.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace conetact::solvers
{
  namespace
  {
    /** Steps in a row without much gain before giving up. */
    constexpr unsigned int max_stalls = 2, max_damped_stalls = 10;

    // Where so many steps are not enough, the load is near its limit or states
    // do not settle: then what a step leaves open matters.
    constexpr unsigned int exact_from = 12;

    /** Residuals below this that do not improve any more are rounding. */
    constexpr double noise = 1e-13;

    /** A load that differs by less from the one in balance is the same. */
    constexpr double rounding = 1e-15;

    /**
     * The same laws, whose friction falls neither with the slip nor, as a
     * coefficient, with pressure: each step sees cones of the point where it
     * starts. Where friction falls faster than bodies resist, Newton's method
     * goes the wrong way; with these slopes slips grow from step to step until
     * friction holds them. Limits are those of the laws themselves.
     */
    class WithoutFall : public NodalLaws
    {
    public:
      explicit WithoutFall(std::shared_ptr<const NodalLaws> l)
        : laws(std::move(l))
      {}

      FrictionLimit
      limit(const Index  node,
            const double s,
            const double slip,
            const double gap) const override
      {
        FrictionLimit result = laws->limit(node, s, slip, gap);
        if (s > 0 && !laws->is_bonded(node))
          result.by_force = std::max(result.by_force, result.value / s);
        result.by_slip = std::max(result.by_slip, 0.);
        return result;
      }
      Aspect
      aspect(const Index  node,
             const double s,
             const double slip,
             const double gap) const override
      {
        return laws->aspect(node, s, slip, gap);
      }
      bool
      has_ellipses() const override
      {
        return laws->has_ellipses();
      }
      Layer
      layer(const Index  node,
            const double r_n,
            const double slip) const override
      {
        return laws->layer(node, r_n, slip);
      }
      bool
      has_cones() const override
      {
        return false;
      }
      bool
      has_layers() const override
      {
        return laws->has_layers();
      }
      Bond
      bond(const Index node, const double slip, const double gap) const override
      {
        return laws->bond(node, slip, gap);
      }
      bool
      is_bonded(const Index node) const override
      {
        return laws->is_bonded(node);
      }
      bool
      has_bonds() const override
      {
        return laws->has_bonds();
      }
      bool
      is_apart(const Index node) const override
      {
        return laws->is_apart(node);
      }
      bool
      is_joined(const Index node) const override
      {
        return laws->is_joined(node);
      }

    private:
      std::shared_ptr<const NodalLaws> laws;
    };

    ContactProblem
    without_fall(const ContactProblem &problem)
    {
      ContactProblem result = problem;
      result.laws           = std::make_shared<WithoutFall>(problem.laws);
      return result;
    }
  } // namespace



  ActiveSet::ActiveSet(const SolverOptions &solver_options)
    : options(solver_options)
  {}



  void
  ActiveSet::attach(const ContactProblem &problem)
  {
    if (!relation || !relation->is(problem.system))
      {
        // Factors and the last change of load belong to the matrix that they
        // came from.
        relation.emplace(problem.system);
        newton    = NewtonSystem();
        predictor = Predictor();
      }
    relation->set_load(problem);
  }



  ActiveSet::Array
  ActiveSet::dual(const Array &p) const
  {
    eigen_assert(relation);
    Array d = relation->load();
    relation->multiply_add(p, d);
    return d;
  }



  ActiveSet::Point
  ActiveSet::point_at(const Array &p) const
  {
    Point point;
    point.p        = p;
    point.d        = dual(p);
    point.residual = law_residual(*relation, point.p, point.d);
    return point;
  }



  bool
  ActiveSet::is_balanced(const Array &p) const
  {
    constexpr double small = 1e-3; // or it would have moved without end
    const Array      d     = dual(p);
    return d.tail(relation->system().n_motions).norm() <=
           small * relation->force_scale(p, d);
  }



  /**
   * Where all nodes that hold a body slip, nothing holds it: the strongest one
   * sticks then, or all of them if that is not enough, until they are seen to
   * slip with something left that holds.
   */
  bool
  ActiveSet::direction(const Point &point, const double precision, Array &dp)
  {
    const Array none  = Array::Zero(point.p.size());
    const auto  solve = [&](const NodeSets &sets, const bool regularised) {
      return newton.solve(*relation,
                          linearized_laws(*relation, sets, point.p, point.d),
                          none,
                          precision,
                          dp,
                          regularised);
    };
    if (relation->system().n_motions == 0)
      return solve(point.sets, true);
    // A regularised matrix always has a solution. It is worth something only if
    // the motions are in balance there.
    const auto solve_balanced = [&](const NodeSets &sets) {
      return solve(sets, false) ||
             (solve(sets, true) && is_balanced(point.p + dp));
    };
    if (solve_balanced(point.sets))
      return true;
    // one that slips again at once does not hold either
    if (solve_balanced(with_strongest_stuck(*relation, point.sets, point.p)))
      {
        const Array p = point.p + dp;
        if (signature(sets_of_point(*relation, p, dual(p))) !=
            signature(point.sets))
          return true;
      }
    const NodeSets stuck = without_slip(*relation, point.sets);
    return solve(stuck, false) || solve(stuck, true);
  }



  /** One Newton step; false if there is none. */
  bool
  ActiveSet::step(Point       &point,
                  const bool   damped,
                  const double goal,
                  const bool   exact)
  {
    // What Newton gains anyway, or what is left to gain if that is less.
    const double precision =
      exact ?
        0. :
        std::min(1e-2,
                 std::max(.1 * point.residual, .3 * goal / point.residual));
    Array dp;
    if (!direction(point, precision, dp))
      return false;

    Point trial = point_at(point.p + dp);
    if (damped)
      // The shortest step is taken even if it gains nothing: it may lead out of
      // a cycle.
      for (double tau = .5; tau > .02 && !(trial.residual < point.residual);
           tau /= 2)
        trial = point_at(point.p + tau * dp);
    if (!std::isfinite(trial.residual))
      return false;
    point      = std::move(trial);
    point.sets = sets_of_point(*relation, point.p, point.d);
    return true;
  }



  std::string
  ActiveSet::iterate(Point &point, SolverReport &report)
  {
    // Well below the tolerance: verification compares with the forces of one
    // body, which may be far smaller than the norm of all.
    const double          goal = std::max(1e-4 * options.tolerance, 1e-14);
    std::set<std::string> seen;
    std::string           current = signature(point.sets);
    const ContactSystem  &system  = relation->system();
    const bool            is_linear =
      system.n_contact_unknowns() <= 2 * system.n_nodes() &&
      relation->has_cones();
    bool         damped = false;
    unsigned int stalls = 0;
    // The residual of the first point says nothing: its states are not those
    // of its z.
    point.d        = dual(point.p);
    point.residual = std::numeric_limits<double>::infinity();
    while (report.iterations < options.max_iterations)
      {
        if (options.stop && options.stop())
          return "stopped by the limit of time";
        seen.insert(current);
        const double before = point.residual;
        if (!step(point, damped, goal, report.iterations >= exact_from))
          return "singular tangent";
        ++report.iterations;

        const std::string next     = signature(point.sets);
        const bool        same     = next == current;
        const bool        improved = point.residual < .5 * before;
        current                    = next;
        stalls                     = improved ? 0 : stalls + 1;
        // In the plane a step is exact if the states are, as far as friction is
        // linear; else one of a small system costs nothing, and squares what is
        // left. Of laws beyond cones nothing is left of a step that gets so
        // far.
        const bool enough = (same && (is_linear || !relation->has_cones())) ||
                            !improved || !newton.was_small();
        const bool is_noise =
          point.residual <= noise && same && (is_linear || !improved);
        if ((point.residual <= goal && enough) || is_noise ||
            (same && stalls > max_stalls))
          break;
        // States seen before, and nothing gained since: a cycle. Full steps
        // would go round in it for ever.
        if (!same && !improved && seen.count(next) > 0)
          {
            if (damped && stalls > max_damped_stalls)
              return "cycling between state sets";
            damped = true;
          }
      }
    return point.residual <= options.tolerance ? "" : stalled(point.residual);
  }



  SolverReport
  ActiveSet::run(const ContactProblem &problem,
                 Point                &point,
                 ContactState         &state)
  {
    SolverReport       report;
    const unsigned int before = newton.n_factorizations();
    report.reason             = iterate(point, report);
    report.factorizations     = newton.n_factorizations() - before;

    // With exact zeros the states need no tolerance.
    set_exact_zeros(*relation, point.sets, point.p, point.d);
    relation->from_scaled(point.p, point.d, state);
    state.node       = classify(problem, state, 0);
    report.residual  = contact_residual(problem, state);
    report.converged = report.residual <= options.tolerance;
    if (report.converged)
      {
        report.reason.clear();
        report.solver = "active set";
      }
    else if (report.reason.empty())
      report.reason = stalled(report.residual);
    return report;
  }



  SolverReport
  ActiveSet::solve_from_states(const ContactProblem &problem,
                               ContactState         &state)
  {
    Point point;
    relation->to_scaled(state, point.p, point.d);
    point.sets = sets_of_state(*relation, state);
    return run(problem, point, state);
  }



  /* Near the end Newton's own slopes are the better ones. */
  SolverReport
  ActiveSet::solve_without_fall(const ContactProblem &problem,
                                ContactState         &state)
  {
    constexpr unsigned int most    = 5;
    const ContactProblem   without = without_fall(problem);
    attach(without);
    SolverReport sum = solve_from_states(without, state);
    for (unsigned int i = 0; i < most && state.v.allFinite(); ++i)
      {
        ContactState end    = state;
        SolverReport report = polish(problem, end);
        add_work(report, sum);
        sum = report;
        if (sum.converged)
          {
            state = end;
            return sum;
          }
        report = polish(without, state);
        add_work(report, sum);
        sum           = report;
        sum.converged = false;
      }
    return sum;
  }



  SolverReport
  ActiveSet::unchanged(const ContactProblem &problem, ContactState &state) const
  {
    SolverReport report;
    state.node       = classify(problem, state, 0);
    report.residual  = contact_residual(problem, state);
    report.converged = report.residual <= options.tolerance;
    report.solver    = "active set";
    return report;
  }



  SolverReport
  ActiveSet::solve(const ContactProblem &problem, ContactState &state)
  {
    attach(problem);
    ContactState start = state;
    start.u            = Array(); // v is where the increment starts
    Array p, d;
    relation->to_scaled(start, p, d);
    // Up to its sign, how far the load has moved from the one that the start is
    // in balance with.
    Array change = d - dual(p);
    if (change.norm() <= rounding * std::max({p.norm(), d.norm(), 1.}))
      if (const SolverReport report = unchanged(problem, start);
          report.converged)
        {
          state.node = start.node;
          return report;
        }

    if (auto end = stay_without_load(problem, start))
      {
        state      = std::move(*end);
        state.node = classify(problem, state, 0);
        SolverReport report;
        report.solver    = "active set";
        report.converged = true;
        return report;
      }

    // Each increment has its own scale of loads; changes of two increments are
    // compared in units.
    ContactState with_units;
    relation->from_scaled(p, change, with_units);
    change = relation->stiffness() ? with_units.r : with_units.v;
    SolverReport report;
    if (std::optional<ContactState> guess = predictor.predict(start, change))
      {
        report = polish(problem, *guess);
        state  = *guess;
      }
    if (!report.converged)
      {
        const unsigned int iterations     = report.iterations;
        const unsigned int factorizations = report.factorizations;
        state                             = start;
        report                            = solve_from_states(problem, state);
        report.iterations += iterations;
        report.factorizations += factorizations;
      }
    if (!report.converged && problem.laws && !problem.laws->has_cones())
      {
        ContactState       other  = start;
        const SolverReport before = report;
        report                    = solve_without_fall(problem, other);
        add_work(report, before);
        if (report.converged)
          state = other;
      }
    if (report.converged)
      predictor.remember(start, state, change);
    return report;
  }



  SolverReport
  ActiveSet::polish(const ContactProblem &problem, ContactState &state)
  {
    attach(problem);
    Point point;
    relation->to_scaled(state, point.p, point.d);
    point.sets = sets_of_point(*relation, point.p, point.d);
    return run(problem, point, state);
  }



  std::unique_ptr<ContactSolver>
  make_active_set(const SolverOptions &options)
  {
    return std::make_unique<ActiveSet>(options);
  }
} // namespace conetact::solvers
